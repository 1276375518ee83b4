// A small ray-marcher for signed distance fields, with a layer of hair strokes.
// A scene gives map(p, &material) and shade(hit); strokes (hair, fur, whiskers)
// are drawn over the rendered picture with a depth test. Output: binary PPM.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

struct V {
    float x = 0, y = 0, z = 0;
};
inline V operator+(V a, V b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V operator-(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V operator*(V a, V b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline V operator*(V a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline float dot(V a, V b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V cross(V a, V b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float length(V a) { return std::sqrt(dot(a, a)); }
inline V norm(V a) { return a * (1 / std::max(length(a), 1e-9f)); }
inline float clamp(float x, float a = 0, float b = 1) { return x < a ? a : x > b ? b : x; }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline V mix(V a, V b, float t) { return a + (b - a) * t; }
inline float smoothstep(float a, float b, float x) {
    const float t = clamp((x - a) / (b - a));
    return t * t * (3 - 2 * t);
}

// Smooth union, intersection and subtraction.
inline float smin(float a, float b, float k) {
    const float h = std::max(k - std::fabs(a - b), 0.f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}
inline float smax(float a, float b, float k) { return -smin(-a, -b, k); }
inline float scut(float a, float b, float k) { return smax(a, -b, k); }

// Primitives.
inline float sphere(V p, V c, float r) { return length(p - c) - r; }
inline float ellipsoid(V p, V c, V r) {
    const V q = p - c;
    const V a{q.x / r.x, q.y / r.y, q.z / r.z};
    const V b{a.x / r.x, a.y / r.y, a.z / r.z};
    const float k = length(a);
    return k * (k - 1) / std::max(length(b), 1e-6f);
}
inline float capsule(V p, V a, V b, float ra, float rb) {
    const V d = b - a, q = p - a;
    const float t = clamp(dot(q, d) / dot(d, d));
    return length(q - d * t) - mix(ra, rb, t);
}
inline V rotX(V p, float a) {
    const float c = std::cos(a), s = std::sin(a);
    return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}
inline V rotY(V p, float a) {
    const float c = std::cos(a), s = std::sin(a);
    return {c * p.x + s * p.z, p.y, -s * p.x + c * p.z};
}
inline V rotZ(V p, float a) {
    const float c = std::cos(a), s = std::sin(a);
    return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

// Noise and random numbers: integer hashes, so every run gives the same picture.
inline uint32_t mixBits(uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352dU;
    h ^= h >> 15;
    h *= 0x846ca68bU;
    return h ^ (h >> 16);
}
inline float hash(int x, int y, int z) {
    const uint32_t h = mixBits(uint32_t(x) * 73856093U ^ uint32_t(y) * 19349663U ^ uint32_t(z) * 83492791U);
    return float(h >> 8) / 16777216.f;
}
inline float noise(V p) {  // value noise, about -1..1
    const float fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    float u = p.x - fx, v = p.y - fy, w = p.z - fz;
    u = u * u * (3 - 2 * u);
    v = v * v * (3 - 2 * v);
    w = w * w * (3 - 2 * w);
    const int x = int(fx), y = int(fy), z = int(fz);
    const auto row = [&](int j, int k) { return mix(hash(x, j, k), hash(x + 1, j, k), u); };
    return 2 * mix(mix(row(y, z), row(y + 1, z), v), mix(row(y, z + 1), row(y + 1, z + 1), v), w) - 1;
}
inline float fbm(V p, int octaves) {
    float s = 0, a = 0.5f;
    for (; octaves > 0; --octaves, a *= 0.5f, p = p * 2.03f) s += a * noise(p);
    return s;
}
struct Random {
    uint32_t state = 1;
    float operator()() { return float(mixBits(state++ * 0x9e3779b9U) >> 8) / 16777216.f; }
    float operator()(float a, float b) { return mix(a, b, (*this)()); }
};

float map(V p, int* material);  // given by the scene

inline V normalAt(V p, float e = 0.0015f) {
    const V a{1, -1, -1}, b{-1, -1, 1}, c{-1, 1, -1}, d{1, 1, 1};
    return norm(a * map(p + a * e, nullptr) + b * map(p + b * e, nullptr) + c * map(p + c * e, nullptr) +
                d * map(p + d * e, nullptr));
}
// Light that reaches p from direction l: 0 in full shadow, 1 in the open; small k is soft.
inline float softShadow(V p, V l, float k, float far) {
    float s = 1, t = 0.02f;
    for (int i = 0; i < 60 && t < far && s > 0.005f; ++i) {
        const float d = map(p + l * t, nullptr);
        s = std::min(s, 0.5f + 0.5f * k * d / t);
        if (s < 0) break;
        t += clamp(d, 0.015f, 0.25f);
    }
    s = clamp(s);
    return s * s * (3 - 2 * s);
}
inline float occlusion(V p, V n, float reach) {
    float o = 0, w = 1;
    for (int i = 1; i <= 5; ++i, w *= 0.75f) {
        const float h = reach * float(i * i) / 25.f;
        o += w * std::max(h - map(p + n * h, nullptr), 0.f);
    }
    return clamp(1 - o / reach * 0.8f);
}

struct Camera {
    V eye, right, up, ahead;
    float scale;
    int w, h;
    Camera(V e, V target, float fovY, int width, int height) : eye(e), w(width), h(height) {
        ahead = norm(target - e);
        right = norm(cross(ahead, {0, 1, 0}));
        up = cross(right, ahead);
        scale = 0.5f * float(h) / std::tan(fovY * 0.5f * 3.14159265f / 180);
    }
    V ray(float px, float py) const {
        return norm(ahead * scale + right * (px - 0.5f * float(w)) - up * (py - 0.5f * float(h)));
    }
    V project(V p) const {  // pixel x, pixel y, distance from the eye
        const V q = p - eye;
        const float z = dot(q, ahead);
        return {0.5f * float(w) + scale * dot(q, right) / z, 0.5f * float(h) - scale * dot(q, up) / z, length(q)};
    }
};

struct Picture {
    int w, h;
    std::vector<V> rgb;
    std::vector<float> depth;
    Picture(int width, int height) : w(width), h(height), rgb(size_t(w) * size_t(h)), depth(rgb.size(), 1e9f) {}
};
// March every pixel; shade(p, ray, material) colours a hit, background(x, y) the rest (x, y in 0..1).
template <class Shade, class Background>
void render(Picture& pic, const Camera& cam, float near, float far, Shade shade, Background background) {
    for (int y = 0; y < pic.h; ++y)
        for (int x = 0; x < pic.w; ++x) {
            const size_t i = size_t(y) * size_t(pic.w) + size_t(x);
            const V d = cam.ray(float(x) + 0.5f, float(y) + 0.5f);
            float t = near;
            int m = -1;
            for (int s = 0; s < 160 && t < far; ++s) {
                const float step = map(cam.eye + d * t, nullptr);
                if (step < 0.0007f) {
                    map(cam.eye + d * t, &m);
                    break;
                }
                t += step * 0.8f;
            }
            if (m < 0) {
                pic.rgb[i] = background(float(x) / float(pic.w), float(y) / float(pic.h));
                continue;
            }
            pic.depth[i] = t;
            pic.rgb[i] = shade(cam.eye + d * t, d, m);
        }
}

// Strokes: short straight pieces of hair, drawn from the farthest to the nearest.
struct Stroke {
    V a, b;
    V colour;
    float width, alpha, bias;
};
inline void drawStrokes(Picture& pic, const Camera& cam, std::vector<Stroke>& strokes) {
    struct Key {
        float z;
        size_t i;
    };
    std::vector<Key> order;
    for (size_t i = 0; i < strokes.size(); ++i) order.push_back({length(strokes[i].a - cam.eye), i});
    std::sort(order.begin(), order.end(), [](Key p, Key q) { return p.z != q.z ? p.z > q.z : p.i < q.i; });
    for (const Key key : order) {
        const Stroke& s = strokes[key.i];
        const V a = cam.project(s.a), b = cam.project(s.b);
        const float r = s.width * 0.5f, dx = b.x - a.x, dy = b.y - a.y;
        const float len2 = std::max(dx * dx + dy * dy, 1e-6f);
        for (int y = int(std::min(a.y, b.y) - r - 1); y <= int(std::max(a.y, b.y) + r + 1); ++y)
            for (int x = int(std::min(a.x, b.x) - r - 1); x <= int(std::max(a.x, b.x) + r + 1); ++x) {
                if (x < 0 || y < 0 || x >= pic.w || y >= pic.h) continue;
                const float px = float(x) + 0.5f - a.x, py = float(y) + 0.5f - a.y;
                const float t = (px * dx + py * dy) / len2;
                if (t < 0 || t > 1) continue;
                const float cover = clamp(r + 0.5f - std::hypot(px - t * dx, py - t * dy));
                const size_t i = size_t(y) * size_t(pic.w) + size_t(x);
                if (cover <= 0 || mix(a.z, b.z, t) > pic.depth[i] + s.bias) continue;
                pic.rgb[i] = mix(pic.rgb[i], s.colour, cover * s.alpha);
            }
    }
}

// Writes the picture, each 2 x 2 block averaged, with a soft shoulder for the lights.
inline void writeHalf(const Picture& pic, FILE* out) {
    const int w = pic.w / 2, h = pic.h / 2;
    std::fprintf(out, "P6\n%d %d\n255\n", w, h);
    const auto tone = [](float v) {
        v = std::max(v, 0.f);
        if (v > 0.7f) v = 0.7f + 0.3f * (1 - std::exp(-(v - 0.7f) / 0.3f));
        return std::pow(v, 1 / 2.2f) * 255.f;
    };
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            V s;
            for (int k = 0; k < 4; ++k) {
                const V c = pic.rgb[size_t(2 * y + k / 2) * size_t(pic.w) + size_t(2 * x + k % 2)];
                s = s + V{tone(c.x), tone(c.y), tone(c.z)} * 0.25f;
            }
            for (float v : {s.x, s.y, s.z}) std::fputc(int(clamp(v + 0.5f, 0, 255)), out);
        }
}
