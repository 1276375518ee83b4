#!/usr/bin/python3
"""Peers of the planner in Debian's Python: scikit-image and SciPy, on maps that planner_bench writes and plans.

    planner_peers.py PLANNER_BENCH [MILLION NODES]

Times are nanoseconds per node. scikit-image is held against its bars on so many nodes (24, for which the bars are
meant); SciPy, whose matrix takes hundreds of bytes a node, stands beside on one million at most. Exits with 1 below
0.85 of a bar, with 2 when the answers are not the same.
"""
import pathlib
import subprocess
import sys
import tempfile
import time

TOLERANCE = 0.85
BARS = (110, 180)  # scikit-image with its constructor, to one thread and to two
SCIPY_MEGA = 1


def timed(run):
    begin = time.perf_counter()
    result = run()
    return result, time.perf_counter() - begin


def answers_differ(peer):
    print(f"planner_peers: {peer} and the planner have other labels", file=sys.stderr)
    sys.exit(2)


class Map:
    """A map's weights, a source (row, column), its `sum` labels, and our nanoseconds per node for these: one thread's,
    two threads'."""

    def __init__(self, program, mega):
        import numpy as np

        self.mega = mega
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/map"
            command = [program, "--write-map", path, "--mega", str(mega)]
            width, height, column, row, *self.own = map(
                float, subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
            )
            self.source = (int(row), int(column))
            shape = (int(height), int(width))
            self.weight = np.fromfile(path, np.uint8).reshape(shape)
            self.sums = np.fromfile(path + ".sums", np.uint32).reshape(shape)


def skimage_is_fast_enough(on):
    import numpy as np
    from skimage.graph import MCP_Geometric

    peer, making = timed(lambda: MCP_Geometric(on.weight.astype(float)))
    (costs, _), finding = timed(lambda: peer.find_costs([on.source]))
    # Our diagonals are 7/5 long, theirs the square root of 2; and our costs are ten times theirs.
    if not np.allclose(costs * 10, on.sums, rtol=0.011):
        answers_differ("scikit-image")
    each = 1e9 / on.weight.size
    nanoseconds = (making + finding) * each
    name = f"scikit-image MCP_Geometric, {on.mega:g} megapixels"
    print(f"{name:<46}{nanoseconds:>7.0f}  of which {making * each:.0f} to make it")
    ok = True
    for threads, own, bar in zip(("one thread", "two threads"), on.own, BARS):
        ratio = nanoseconds / own
        good = ratio >= TOLERANCE * bar
        print(f"    / tiles, {threads:<33}{own:>7.1f}{ratio:>9.0f} / {bar}{'' if good else '  TOO SLOW'}")
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


def run_scipy(on):
    import numpy as np
    from scipy.sparse.csgraph import dijkstra

    matrix, making = timed(lambda: grid_matrix(on.weight))
    index = on.source[0] * on.weight.shape[1] + on.source[1]
    costs, finding = timed(lambda: dijkstra(matrix, directed=False, indices=index))
    if not np.array_equal(costs, on.sums.ravel()):
        answers_differ("SciPy")
    each = 1e9 / on.weight.size
    name = f"SciPy csgraph.dijkstra, {on.mega:g} megapixels"
    print(f"{name:<46}{finding * each:>7.0f}  and {making * each:.0f} to make the matrix")


def main():
    program, mega = pathlib.Path(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 24
    ok = True
    print("portrait, sum, in Python; nanoseconds per node")
    try:
        import skimage  # noqa: F401, before its map is made, which takes a while

        ok = skimage_is_fast_enough(Map(program, mega))
    except ModuleNotFoundError:
        print("scikit-image: left out, as python3-skimage is not installed")
    try:
        import scipy  # noqa: F401

        run_scipy(Map(program, min(mega, SCIPY_MEGA)))
    except ModuleNotFoundError:
        print("SciPy: left out, as python3-scipy is not installed")
    return ok


if __name__ == "__main__":
    sys.exit(0 if main() else 1)
