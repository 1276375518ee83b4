#!/usr/bin/env python3
"""A grey stone surface as a grey PGM: grain, speckles, a few cracks, side light.

Usage: stone.py [width height] > stone.pgm
"""
import math
import random
import sys

W, H = (int(sys.argv[1]), int(sys.argv[2])) if len(sys.argv) > 2 else (900, 600)
rng = random.Random(4)


def lattice(n):
    return [[rng.random() for _ in range(n)] for _ in range(n)]


def noise(grid, x, y):
    """Value noise of a wrapped grid, 0..1."""
    n = len(grid)
    ix, iy = math.floor(x), math.floor(y)
    u, v = x - ix, y - iy
    u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
    a, b = grid[iy % n], grid[(iy + 1) % n]
    i, j = ix % n, (ix + 1) % n
    return (a[i] * (1 - u) + a[j] * u) * (1 - v) + (b[i] * (1 - u) + b[j] * u) * v


def crack(x, y, angle, length):
    """A line of points one pixel apart that wanders about its first direction."""
    points, start = [], angle
    for _ in range(int(length)):
        points.append((x, y))
        angle += rng.gauss(0, 0.13)
        angle += 0.02 * (start - angle)
        x, y = x + math.cos(angle), y + math.sin(angle)
    return points


# Height: broad swells, lumps and grain. Each layer: size in pixels, amplitude.
LAYERS = [(lattice(64), s, a) for s, a in
          ((260, 26), (110, 13), (46, 7), (19, 3.4), (8, 1.7), (3.6, 0.75))]
height = []
for y in range(H):
    row = []
    for x in range(W):
        row.append(sum(a * noise(g, x / s + 0.3 * y / s, y / s - 0.2 * x / s) for g, s, a in LAYERS))
    height.append(row)


def press(x, y, r, depth, sharp=1.0):
    """Lower the surface in a round pit."""
    for j in range(max(0, int(y - r)), min(H, int(y + r) + 2)):
        for i in range(max(0, int(x - r)), min(W, int(x + r) + 2)):
            d = math.hypot(i - x, j - y) / r
            if d < 1:
                height[j][i] -= depth * (1 - d * d) ** sharp


for _ in range(620):  # pits
    press(rng.uniform(0, W), rng.uniform(0, H), 1.2 + 3.8 * rng.random() ** 3, rng.uniform(0.5, 2.0))
for x, y, a, n in ((-5, 430, -0.35, 620), (560, 262, 0.9, 250), (700, -5, 1.9, 190), (80, 605, -1.2, 170)):
    points = crack(x, y, a, n)
    for k, (px, py) in enumerate(points):
        press(px, py, 2.3 - 0.8 * k / len(points), 0.55)

# Minerals: dark and light crystals, then shading by the slope towards the light.
stain = lattice(64)
mineral = lattice(256)
out = bytearray()
for y in range(H):
    for x in range(W):
        dx = height[y][min(x + 1, W - 1)] - height[y][max(x - 1, 0)]
        dy = height[min(y + 1, H - 1)][x] - height[max(y - 1, 0)][x]
        n = 1 / math.sqrt(dx * dx * 0.16 + dy * dy * 0.16 + 1)
        light = (0.42 * 0.4 * dx + 0.40 * 0.4 * dy + 0.80) * n
        m = noise(mineral, x / 4.5 + 0.1 * y, y / 4.5)
        tone = 148 + 26 * (noise(stain, x / 150, y / 150) - 0.5) + 16 * (noise(stain, x / 37 + 9, y / 37) - 0.5)
        tone += 26 * max(0.0, m - 0.74) / 0.26 - 44 * max(0.0, 0.24 - m) / 0.24
        fall = 1.06 - 0.20 * math.hypot(x / W - 0.4, y / H - 0.35) ** 2
        out.append(max(0, min(255, round(tone * (0.08 + 1.12 * light) * fall))))

sys.stdout.buffer.write(b"P5\n%d %d\n255\n" % (W, H))
sys.stdout.buffer.write(out)
