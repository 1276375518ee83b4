#!/usr/bin/python3
"""Peers of the planner in Debian's Python: scikit-image and SciPy, on a map that planner_bench writes.

    planner_peers.py PLANNER_BENCH [MILLION NODES]

Times are nanoseconds per node. Where planner_bench has left its figures, the ratio to them is held against
its bars, too; they are from more nodes than there are here, which is in the peers' favour. Exits with 1
below 0.85 of a bar, with 2 when the answers are not the same.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
import time

TOLERANCE = 0.85
BARS = {"tiles": 110, "tiles_by_two": 180}  # scikit-image with its constructor, to one thread and to two


def timed(run):
    begin = time.perf_counter()
    result = run()
    return result, time.perf_counter() - begin


def answers_differ(peer):
    print(f"planner_peers: {peer} and the planner have other labels", file=sys.stderr)
    sys.exit(2)


def own_figures(program):
    """Nanoseconds of our own `sum` on the same map, as planner_bench left them."""
    try:
        figures = json.loads((program.parent.parent / "planner.json").read_text())
    except FileNotFoundError:
        return {}
    same = ("portrait", "sum", "weights, 8")
    return next((row["ns"] for row in figures["rows"] if (row["map"], row["metric"], row["edges"]) == same), {})


def skimage_is_fast_enough(weight, sums, source, own):
    import numpy as np
    from skimage.graph import MCP_Geometric

    peer, making = timed(lambda: MCP_Geometric(weight.astype(float)))
    (costs, _), finding = timed(lambda: peer.find_costs([source]))
    # Our diagonals are 7/5 long, theirs the square root of 2; and our costs are ten times theirs.
    if not np.allclose(costs * 10, sums, rtol=0.011):
        answers_differ("scikit-image")
    nanoseconds = (making + finding) / weight.size * 1e9
    print(f"{'scikit-image MCP_Geometric':<42}{nanoseconds:>7.0f}  of which {making / weight.size * 1e9:.0f} to make it")
    ok = True
    for name, bar in BARS.items():
        if name in own:
            ratio = nanoseconds / own[name]
            good = ratio >= TOLERANCE * bar
            print(f"    / {name:<36}{ratio:>7.1f} / {bar}{'' if good else '  TOO SLOW'}")
            ok = ok and good
    return ok


def grid_matrix(weight):
    """The lattice's edges as SciPy wants them, each once."""
    import numpy as np
    from scipy.sparse import coo_array

    height, width = weight.shape
    node = np.arange(weight.size, dtype=np.int32).reshape(height, width)
    weight = weight.astype(float)
    here, there, cost = [], [], []
    for dx, dy, length in ((1, 0, 5), (0, 1, 5), (1, 1, 7), (-1, 1, 7)):
        a = np.s_[: height - dy, max(0, -dx) : width - max(0, dx)]
        b = np.s_[dy:, max(0, dx) : width - max(0, -dx)]
        here.append(node[a].ravel())
        there.append(node[b].ravel())
        cost.append(((weight[a] + weight[b]) * length).ravel())
    here, there, cost = map(np.concatenate, (here, there, cost))
    return coo_array((cost, (here, there)), shape=(weight.size, weight.size)).tocsr()


def run_scipy(weight, sums, source):
    import numpy as np
    from scipy.sparse.csgraph import dijkstra

    matrix, making = timed(lambda: grid_matrix(weight))
    index = source[0] * weight.shape[1] + source[1]
    costs, finding = timed(lambda: dijkstra(matrix, directed=False, indices=index))
    if not np.array_equal(costs, sums.ravel()):
        answers_differ("SciPy")
    nanoseconds = finding / weight.size * 1e9
    print(f"{'SciPy csgraph.dijkstra':<42}{nanoseconds:>7.0f}  and {making / weight.size * 1e9:.0f} to make the matrix")


def main():
    program, mega = pathlib.Path(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else "1"
    try:
        import numpy as np
    except ModuleNotFoundError:
        print("planner_peers: left out, as python3-skimage and python3-scipy are not installed")
        return True
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/map"
        run = subprocess.run([program, "--write-map", path, "--mega", mega], check=True, capture_output=True, text=True)
        width, height, column, row = map(int, run.stdout.split())
        weight = np.fromfile(path, np.uint8).reshape(height, width)
        sums = np.fromfile(path + ".sums", np.uint32).reshape(height, width)
    print(f"portrait, sum, {mega} megapixels, in Python; nanoseconds per node")
    ok = True
    try:
        ok = skimage_is_fast_enough(weight, sums, (row, column), own_figures(program))
    except ModuleNotFoundError:
        print("scikit-image: left out, as python3-skimage is not installed")
    try:
        run_scipy(weight, sums, (row, column))
    except ModuleNotFoundError:
        print("SciPy: left out, as python3-scipy is not installed")
    return ok


if __name__ == "__main__":
    sys.exit(0 if main() else 1)
