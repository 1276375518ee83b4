// A tabby cat's head and chest: a signed distance field, covered with fur strokes.
// Usage: cat [width of the picture] > cat.ppm
#include "march.h"

enum Material { Fur, Eye, Nose, Ear };

static const float kYaw = 0.16f, kTilt = -0.06f, kNod = 0.05f;  // pose of the head
static V toHead(V p) { return rotX(rotZ(rotY(p, -kYaw), -kTilt), -kNod); }
static V toWorld(V p) { return rotY(rotZ(rotX(p, kNod), kTilt), kYaw); }
static V mirror(V p) { return {std::fabs(p.x), p.y, p.z}; }

static const V kEye{0.40f, 0.10f, 0.60f};
static const float kEyeR = 0.285f;
static const V kNose{0, -0.20f, 1.0f};

// Signed distance to the opening between the lids; u grows outwards.
static float lidOpening(float u, float v) {
    v -= 0.28f * u;
    const float t = u / 0.232f, w = std::max(1 - t * t, -1.f);
    const float top = 0.160f * (w > 0 ? std::pow(w, 0.8f) : w), bottom = -0.150f * (w > 0 ? std::pow(w, 0.8f) : w);
    return std::max(v - top, bottom - v) * 0.7f;
}
// Distance to the lines of the mouth: down from the nose, then out in two curves.
static float mouthLine(V p) {  // p.x >= 0
    const float stem = std::hypot(p.x, std::max({0.f, p.y + 0.27f, -0.42f - p.y}));
    const float y = -0.42f - 0.10f * std::sin(clamp(p.x / 0.30f) * 3.14159f) + 0.02f * p.x;
    const float side = std::hypot(p.y - y, std::max(0.f, p.x - 0.30f)) * 0.8f;
    return p.z > 0.5f ? std::min(stem, side) : 1;
}

static float earShape(V p, float grow) {  // p.x >= 0
    const V a{0.48f, 0.52f, -0.05f}, b{0.93f, 1.46f, -0.10f};
    V q = p - a;
    const V axis = norm(b - a);
    const float len = length(b - a), t = dot(q, axis);
    q = q - axis * t;
    const float r = 0.50f * std::pow(clamp(1 - t / len), 0.75f) + 0.012f;
    return std::max({std::hypot(q.x, q.y) - r, std::fabs(q.z) * 0.9f - r * 0.62f, -t - 0.4f, t - len * 0.965f}) * 0.7f -
           grow;
}

static float head(V p) {  // p.x >= 0
    float d = ellipsoid(p, {0, 0.14f, 0}, {0.93f, 0.80f, 0.86f});
    d = smin(d, ellipsoid(p, {0.60f, -0.30f, 0.18f}, {0.54f, 0.38f, 0.48f}), 0.30f);      // cheek
    d = smin(d, capsule(p, {0, 0.32f, 0.66f}, {0, -0.16f, 0.90f}, 0.17f, 0.13f), 0.22f);  // bridge
    d = scut(d, ellipsoid(p, {0.42f, 0.10f, 0.95f}, {0.24f, 0.20f, 0.16f}), 0.15f);       // socket
    d = smin(d, ellipsoid(p, {0.19f, -0.37f, 0.80f}, {0.25f, 0.20f, 0.22f}), 0.10f);      // muzzle
    d = smin(d, ellipsoid(p, {0, -0.60f, 0.68f}, {0.22f, 0.14f, 0.19f}), 0.08f);          // chin
    d = scut(d, std::max(mouthLine(p), 0.6f - p.z) - 0.006f, 0.04f);
    d = smin(d, scut(earShape(p, 0), earShape(p - V{-0.02f, -0.05f, 0.22f}, -0.05f), 0.05f), 0.12f);
    const V e = p - kEye;
    const float r = length(e);
    if (r < 0.6f) {
        d = smin(d, r - kEyeR - 0.035f, 0.08f);
        d = smax(d, -std::max(lidOpening(e.x, e.y), 0.4f - p.z), 0.025f);
    }
    return d;
}
static float body(V p) {
    float d = ellipsoid(p, {0.05f, -2.2f, -0.75f}, {1.12f, 1.75f, 1.0f});
    d = smin(d, ellipsoid(p, {0.02f, -1.45f, -0.1f}, {0.66f, 0.85f, 0.55f}), 0.4f);
    const V s{std::fabs(p.x - 0.05f), p.y, p.z};
    return smin(d, capsule(s, {0.50f, -1.7f, -0.2f}, {0.42f, -3.0f, 0.25f}, 0.36f, 0.30f), 0.25f);  // forelegs
}
static float nosePad(V p) {
    const V q = p - V{0, -0.205f, 1.0f};
    return ellipsoid({q.x / (1 + 2.6f * q.y), q.y, q.z}, {0, 0, 0}, {0.125f, 0.085f, 0.075f}) * 0.8f;
}

float map(V w, int* material) {
    const V p = toHead(w), s = mirror(p);
    const float far = length(p - V{0, 0.2f, 0}) - 1.75f;
    float d = body(w);
    int m = Fur;
    if (far > 0.3f) {
        if (material) *material = m;
        return std::min(d, far);
    }
    d = smin(d, head(s), 0.25f);
    const float eye = length(s - kEye) - kEyeR, nose = nosePad(s);
    if (nose < d) {
        d = nose;
        m = Nose;
    }
    if (eye < d) {
        d = eye;
        m = Eye;
    }
    if (m == Fur && p.y > 0.5f && earShape(s - V{-0.02f, -0.05f, 0.22f}, -0.05f) < 0.02f) m = Ear;
    if (material) *material = m;
    return d;
}

static const V kKey = norm({-0.60f, 0.75f, 0.62f}), kRim = norm({0.80f, 0.45f, -0.30f});
static const V kEyePos{0, 0.0f, 10};

static float stripe(float phase, float width) {  // 1 on a stripe, soft edges
    return smoothstep(width - 0.25f, width + 0.35f, std::cos(phase));
}
// The tabby coat: where the stripes and the white parts are.
static V coat(V w) {
    const V p = toHead(w), s = mirror(p);
    const V warm{0.40f, 0.30f, 0.21f}, dark{0.010f, 0.008f, 0.007f}, white{0.86f, 0.83f, 0.78f};
    const float wob = 0.6f * fbm(p * 3.2f, 3);
    if (p.y < -0.75f || p.z < -0.45f) {  // chest and shoulders
        const float x = std::fabs(w.x - 0.05f);
        V c = mix(warm, dark, 0.93f * stripe(w.y * 15 - 7 * x + 3.2f * wob, 0.0f));
        return mix(c, white,
                   smoothstep(0.50f, 0.26f, x + 0.25f * wob + 0.10f * (w.y + 1.2f)) * smoothstep(-0.8f, -1.0f, p.y));
    }
    V c = mix(warm, warm * 1.35f, clamp(0.5f + wob));
    float k = 0;
    if (p.y > 0.2f)  // forehead: stripes that fan out to the ears, an M over the eyes
        k = stripe(s.x * mix(36, 22, clamp(p.y - 0.2f)) + 1.2f * wob + 3.1f, 0.0f) *
            smoothstep(0.34f, 0.48f, p.y - 0.12f * s.x) * smoothstep(0.80f, 0.60f, s.x);
    const float ang = std::atan2(p.y + 0.05f - 0.10f, s.x - 0.30f);  // cheek: stripes from the eye outwards
    k = std::max(
        k, stripe(ang * 13 + 1.4f * wob + 1.5f, 0.0f) * smoothstep(0.58f, 0.72f, s.x) * smoothstep(0.45f, 0.2f, p.y));
    const V e = s - kEye;
    const float open = lidOpening(e.x, e.y);
    c = mix(c, dark, 0.92f * k);
    c = mix(
        c, white * 0.85f,
        0.75f * smoothstep(0.10f, 0.06f, open) * (p.z > 0.3f ? 1.f : 0.f) * (p.y < 0.02f || s.x < 0.42f ? 0.8f : 0.5f));
    c = mix(c, dark, smoothstep(0.045f, 0.025f, open) * (p.z > 0.3f ? 1.f : 0.f));
    c = mix(c, dark,
            0.9f * smoothstep(
                       0.05f, 0.02f,
                       std::hypot(p.y + 0.08f + 0.9f * (s.x - 0.22f), std::max(0.f, std::fabs(s.x - 0.20f) - 0.05f))));
    const float muzzle = length((s - V{0.14f, -0.44f, 0.85f}) * V{1 / 0.38f, 1 / 0.30f, 1 / 0.6f});
    c = mix(c, white, smoothstep(1.08f, 0.88f, muzzle + 0.15f * wob));
    c = mix(c, mix(warm, V{0.30f, 0.16f, 0.10f}, 0.5f),
            smoothstep(0.16f, 0.08f, s.x) * smoothstep(-0.16f, -0.05f, p.y) * smoothstep(0.35f, 0.1f, p.y) * 0.7f);
    c = mix(c, white, smoothstep(-0.60f, -0.72f, p.y) * smoothstep(0.6f, 0.4f, s.x));
    for (int i = 0; i < 7; ++i) {  // dark whisker roots
        const V r{0.16f + 0.065f * float(i % 4), -0.32f - 0.07f * float(i / 4), 0};
        c = mix(c, dark,
                0.8f * smoothstep(0.020f, 0.008f, std::hypot(s.x - r.x, s.y - r.y)) * (p.z > 0.6f ? 1.f : 0.f));
    }
    return mix(c, dark, smoothstep(0.022f, 0.010f, mouthLine(s)) * (p.z > 0.55f ? 1.f : 0.f));
}

static V shadeHit(V p, V d, int m) {
    V n = normalAt(p), albedo;
    const V h = toHead(p), s = mirror(h);
    float gloss = 0, power = 20, wrap = 0.25f;
    if (m == Fur) {
        albedo = coat(p);
        n = norm(n + V{noise(p * 9), noise(p * 9 + V{7, 0, 0}), 0} * 0.20f);
    } else if (m == Ear) {
        albedo = mix(V{0.42f, 0.25f, 0.21f}, V{0.10f, 0.09f, 0.07f}, smoothstep(1.0f, 0.6f, h.y));
    } else if (m == Nose) {
        albedo = V{0.52f, 0.22f, 0.19f};
        const float hole = length((s - V{0.075f, -0.235f, 1.05f}) * V{1 / 0.035f, 1 / 0.022f, 1 / 0.09f});
        albedo = mix(V{0.03f, 0.015f, 0.015f}, albedo,
                     smoothstep(0.7f, 1.1f, hole) * smoothstep(0.004f, 0.014f, s.x + std::max(0.f, h.y + 0.22f)));
        gloss = 0.25f;
        power = 25;
    } else {
        const V c = toWorld({h.x < 0 ? -kEye.x : kEye.x, kEye.y, kEye.z});
        const V gaze = norm(kEyePos + V{h.x < 0 ? 0.3f : 1.0f, 0.1f, 0} - c), o = norm(p - c);
        const V q = (o - gaze) * kEyeR;
        const float r = length(q), streak = noise(norm(o - gaze * dot(o, gaze)) * 16);
        albedo =
            mix(V{0.62f, 0.60f, 0.16f}, V{0.36f, 0.46f, 0.13f}, smoothstep(0.06f, 0.17f, r)) * (1 + 0.22f * streak);
        albedo = mix(albedo, V{0.10f, 0.09f, 0.04f}, smoothstep(0.165f, 0.205f, r));
        const float pupil = std::hypot(q.x / 0.066f, q.y / 0.150f);
        albedo = mix(V{0.004f, 0.004f, 0.004f}, albedo, smoothstep(0.92f, 1.06f, pupil));
        if (length(o - norm(gaze + V{-0.24f, 0.30f, 0.05f})) < 0.16f) return V{1.2f, 1.2f, 1.2f};
        albedo = albedo * (1 + 0.5f * smoothstep(0.1f, -0.12f, q.y));
        n = norm(mix(n, gaze, 0.4f));
        gloss = 0.2f;
        power = 50;
        wrap = 0.4f;
    }
    const float shadow = softShadow(p + n * 0.02f, kKey, 6, 3.0f), ao = occlusion(p, n, 0.4f);
    const float key = clamp((dot(n, kKey) + wrap) / (1 + wrap)) * shadow;
    const float sky = (0.6f + 0.4f * n.y) * ao, rim = std::pow(clamp(dot(n, kRim)), 1.5f) * ao;
    const V light = V{1.0f, 0.95f, 0.87f} * (1.25f * key) + V{0.8f, 0.88f, 1.0f} * (0.17f * sky + 0.55f * rim);
    const float spec = gloss * std::pow(clamp(dot(n, norm(kKey - d))), power) * shadow;
    return albedo * light + V{spec, spec, spec};
}

// Fur: short strokes that start at visible points of the coat and take their colour there.
static void growFur(std::vector<Stroke>& out, const Picture& pic, const Camera& cam) {
    Random rnd{3};
    const float px = float(pic.w) / 1800;
    const int count = int(0.13f * float(pic.w) * float(pic.h));
    for (int k = 0; k < count; ++k) {
        const int x = int(rnd() * float(pic.w)), y = int(rnd() * float(pic.h));
        const float r1 = rnd(), r2 = rnd(-1, 1), r3 = rnd(-1, 1), r4 = rnd();
        const size_t i = size_t(y) * size_t(pic.w) + size_t(x);
        if (pic.depth[i] > 1e8f) continue;
        const V w = cam.eye + cam.ray(float(x) + 0.5f, float(y) + 0.5f) * pic.depth[i];
        int m = 0;
        map(w, &m);
        if (m == Eye || m == Nose) continue;
        const V n = normalAt(w), h = toHead(w), s = mirror(h);
        V flow = h - (kNose + V{0, 0.10f, 0.1f});
        const V e = s - kEye;
        const float near = std::exp(-(e.x * e.x + e.y * e.y) / 0.10f);
        flow = norm(norm(flow) + V{h.x < 0 ? -e.x : e.x, e.y, 0} * (6 * near));
        V dir = toWorld(flow);
        float len = mix(0.035f, 0.15f, smoothstep(0.1f, 1.0f, length(h - kNose))) *
                    (1 + 0.6f * smoothstep(0.75f, 1.0f, s.x) * smoothstep(0.1f, -0.2f, s.y)) * (1 - 0.5f * near);
        if (h.y > 0.7f) {
            dir = toWorld(norm(V{h.x < 0 ? -0.45f : 0.45f, 1, 0}));
            len = mix(0.10f, 0.05f, smoothstep(0.9f, 1.3f, h.y));
        }
        const float chest = smoothstep(-0.62f, -0.95f, h.y);
        dir = mix(dir, V{0.25f * (w.x - 0.05f), -1, 0.1f}, chest);
        len = mix(len, 0.22f, chest);
        dir = norm(dir + V{r2, r3, 0} * 0.28f + V{noise(w * 5), noise(w * 5 + V{9, 9, 9}), 0} * 0.35f);
        dir = norm(dir - n * dot(dir, n) + n * 0.28f);
        if (m == Ear) {
            len = 0.16f;
            dir = norm(toWorld({h.x < 0 ? 0.3f : -0.3f, 0.8f, 0.6f}) + V{r2, r3, 0} * 0.4f);
            if (r4 < 0.8f) continue;
        }
        len *= 0.6f + 0.6f * r1;
        const float tint = m == Ear ? 1.7f : r4 < 0.5f ? mix(0.55f, 0.9f, r1) : mix(1.0f, 1.35f, r1);
        V a = w, c = pic.rgb[i] * tint;
        if (m == Ear) c = c + V{0.12f, 0.11f, 0.10f};
        for (int j = 0; j < 4; ++j) {
            const V b = a + dir * (len * 0.25f);
            out.push_back({a, b, c, px * (1.9f - 0.35f * float(j)), 0.75f, 0.05f});
            dir = norm(dir + V{0, -0.06f, 0} - n * 0.05f);
            a = b;
        }
    }
}
static void growWhiskers(std::vector<Stroke>& out, float px) {
    Random rnd{12};
    for (int sgn = -1; sgn <= 1; sgn += 2)
        for (int i = 0; i < 15; ++i) {
            const bool brow = i > 11;
            V p = brow ? V{0.36f + 0.05f * float(i - 12), 0.42f, 0.78f}
                       : V{0.20f + 0.055f * float(i % 4), -0.33f - 0.06f * float(i / 4), 0.97f};
            V d = brow ? norm({0.30f + 0.25f * float(i - 12), 1, 0.35f})
                       : norm({1, 0.30f - 0.20f * float(i / 4) + rnd(-0.09f, 0.09f), 0.35f});
            const float len = brow ? rnd(0.5f, 0.7f) : rnd(1.0f, 1.55f);
            for (int k = 0; k < 40; ++k) {
                const V q = p + d * (len / 40);
                out.push_back({toWorld({sgn * p.x, p.y, p.z}), toWorld({sgn * q.x, q.y, q.z}), V{0.95f, 0.94f, 0.90f},
                               px * (2.4f - 0.045f * float(k)), 0.9f, 0.3f});
                d = norm(d + V{0, -0.012f, -0.014f});
                p = q;
            }
        }
}

int main(int argc, char** argv) {
    const int w = 2 * (argc > 1 ? std::atoi(argv[1]) : 880);
    Picture pic(w, w);
    const Camera cam(kEyePos, {0, -0.17f, 0}, 21.5f, w, w);
    render(pic, cam, 7.5f, 13, shadeHit, [](float x, float y) {  // a calm wall, lighter on the right
        return mix(V{0.34f, 0.37f, 0.36f}, V{0.80f, 0.80f, 0.75f},
                   clamp(0.15f + 0.9f * x - 0.45f * y + 0.04f * fbm({x * 4, y * 4, 1}, 3)));
    });
    std::vector<Stroke> strokes;
    growFur(strokes, pic, cam);
    growWhiskers(strokes, float(w) / 1800);
    drawStrokes(pic, cam, strokes);
    writeHalf(pic, stdout);
}
