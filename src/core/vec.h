#pragma once
#include <cmath>

namespace dstylize {

/// A point or direction in the plane, y down. Which frame it lives in is said by the name that holds
/// it: `_px` is the picture frame (upright input pixels, pixel (i, j) covers [i, i+1) x [j, j+1)),
/// `_lattice` the lattice frame (node (i, j) sits at (i + 0.5, j + 0.5)).
struct Vec2f {
    float x = 0, y = 0;
    friend bool operator==(const Vec2f&, const Vec2f&) = default;
    friend Vec2f operator+(Vec2f a, Vec2f b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2f operator-(Vec2f a, Vec2f b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2f operator*(Vec2f a, float k) { return {a.x * k, a.y * k}; }
    friend Vec2f operator*(float k, Vec2f a) { return a * k; }
};

inline float dot(Vec2f a, Vec2f b) { return a.x * b.x + a.y * b.y; }
inline float length(Vec2f a) { return std::sqrt(dot(a, a)); }
inline float distance(Vec2f a, Vec2f b) { return length(a - b); }
inline Vec2f lerp(Vec2f a, Vec2f b, float t) { return a + (b - a) * t; }
/// Quarter turn from +x towards +y.
inline Vec2f perpendicular(Vec2f a) { return {-a.y, a.x}; }
/// `a` scaled to length 1; the zero vector stays zero.
inline Vec2f normalized(Vec2f a) {
    const float l = length(a);
    return l > 0 ? a * (1 / l) : Vec2f{};
}

/// A point in space: the picture plane at z = 0, z towards the viewer.
struct Vec3f {
    float x = 0, y = 0, z = 0;
    friend bool operator==(const Vec3f&, const Vec3f&) = default;
};

/// Smooth ramp from 0 at `lo` to 1 at `hi` (Hermite).
inline float smoothstep(float lo, float hi, float x) {
    float t = (x - lo) / (hi - lo);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

}  // namespace dstylize
