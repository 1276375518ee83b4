// The portrait: a bust of a woman with a side-parted bob, as a signed distance field.
// Usage: portrait [width of the picture] > portrait.ppm     (unit of length: 10 cm)
#include "march.h"

#include <initializer_list>
#include <utility>

enum Material { Skin, Eye, HairMass, Coat, Shirt };

static const float kYaw = -0.30f, kTilt = 0.05f, kNod = 0.03f;  // pose of the head
static V toHead(V p) { return rotX(rotZ(rotY(p, -kYaw), -kTilt), -kNod); }
static V toWorld(V p) { return rotY(rotZ(rotX(p, kNod), kTilt), kYaw); }

static const V kEye{0.325f, 0, 0.655f};
static const float kEyeR = 0.2f;

// Signed distance (in the plane x, y) to the opening between the lids; u grows outwards.
static float lidOpening(float u, float v) {
    v -= 0.10f * u;
    const float t = u / 0.170f, w = std::max(1 - t * t, -1.f);
    const float top = 0.069f * w * (1 - 0.15f * t), bottom = -0.052f * w * (1 + 0.25f * t);
    return std::max(v - top, bottom - v) * 0.8f;
}
// Height of the line between the lips.
static float mouthLine(float x) {
    return -0.690f + 0.028f * std::cos(std::min(x / 0.10f, 3.14159f)) * 0.5f + 0.30f * std::max(x - 0.12f, 0.f);
}

static float lipMask(V p) {  // 1 on the lips, 0 on the skin; p.x >= 0
    const float t = p.x / 0.255f, w = 1 - t * t, m = mouthLine(p.x);
    if (w <= 0 || p.z < 0.6f) return 0;
    const float bow = 0.018f * std::exp(-p.x * p.x / 0.0016f);
    const float top = m + 0.082f * std::pow(w, 0.8f) - bow, low = m - 0.105f * std::sqrt(w);
    return smoothstep(-0.004f, 0.014f, std::min(top - p.y, p.y - low));
}

static float face(V p) {                                                 // p.x >= 0
    float d = ellipsoid(p, {0, 0.36f, -0.06f}, {0.755f, 0.80f, 0.96f});  // cranium
    d = smin(d, ellipsoid(p, {0, -0.33f, 0.32f}, {0.575f, 0.76f, 0.57f}), 0.28f);
    d = smin(d, capsule(p, {0.47f, -0.55f, 0.12f}, {0.13f, -0.98f, 0.62f}, 0.13f, 0.13f), 0.22f);
    d = smin(d, ellipsoid(p, {0, -1.00f, 0.735f}, {0.15f, 0.13f, 0.13f}), 0.16f);                  // chin
    d = smin(d, ellipsoid(p, {0.41f, -0.22f, 0.58f}, {0.16f, 0.14f, 0.16f}), 0.26f);               // cheekbone
    d = smin(d, ellipsoid(p, {0.29f, -0.52f, 0.62f}, {0.18f, 0.22f, 0.16f}), 0.25f);               // cheek
    d = smin(d, ellipsoid(p, {0, 0.50f, 0.66f}, {0.42f, 0.30f, 0.22f}), 0.2f);                     // forehead
    d = scut(d, ellipsoid(p, {0.31f, -0.02f, 0.99f}, {0.19f, 0.12f, 0.15f}), 0.13f);               // socket
    d = smin(d, capsule(p, {0.13f, 0.185f, 0.82f}, {0.46f, 0.20f, 0.65f}, 0.055f, 0.05f), 0.12f);  // brow
    d = smin(d, ellipsoid(p, {0, -0.68f, 0.76f}, {0.27f, 0.22f, 0.18f}), 0.16f);                   // muzzle
    // Nose: bridge, tip, wings, nostrils.
    d = smin(d, capsule(p, {0, 0.14f, 0.85f}, {0, -0.27f, 1.05f}, 0.042f, 0.060f), 0.12f);
    d = smin(d, ellipsoid(p, {0, -0.330f, 1.075f}, {0.080f, 0.07f, 0.075f}), 0.07f);
    d = smin(d, ellipsoid(p, {0.092f, -0.365f, 0.950f}, {0.048f, 0.052f, 0.085f}), 0.075f);
    d = scut(d, ellipsoid(p, {0.052f, -0.425f, 1.01f}, {0.026f, 0.024f, 0.046f}), 0.03f);
    d = scut(d, capsule(p, {0, -0.47f, 1.0f}, {0, -0.58f, 1.0f}, 0.022f, 0.03f), 0.05f);  // philtrum
    // Lips: two soft rolls and the line between them.
    const float m = mouthLine(p.x);
    d = smin(d, capsule(p, {0.03f, -0.652f, 0.935f}, {0.22f, -0.685f, 0.835f}, 0.044f, 0.02f), 0.05f);
    d = smin(d, capsule(p, {0.0f, -0.745f, 0.925f}, {0.12f, -0.735f, 0.895f}, 0.060f, 0.045f), 0.04f);
    d = scut(d, std::max({std::fabs(p.y - m) - 0.004f, p.x - 0.235f, 0.7f - p.z}),
             0.004f + 0.028f * clamp(1 - p.x / 0.25f));
    d = scut(d, ellipsoid(p, {0, -0.865f, 0.945f}, {0.15f, 0.035f, 0.05f}), 0.07f);  // below lip
    // Lids: a shell round the eyeball, cut open; the crease above it.
    const V e = p - kEye;
    const float u = e.x, v = e.y, r = length(e);
    if (r < 0.5f) {
        d = smin(d, r - kEyeR - 0.030f, 0.05f);
        const float crease = std::fabs(v - 0.10f * u - 0.150f * (1 - 0.55f * u * u / 0.03f)) - 0.002f;
        if (p.z > 0.5f && std::fabs(u) < 0.17f) d = scut(d, std::max(crease, r - 0.26f), 0.022f);
        d = smax(d, -std::max(lidOpening(u, v), 0.5f - p.z), 0.016f);
    }
    // Ear.
    d = smin(d, ellipsoid(p, {0.76f, -0.12f, -0.05f}, {0.06f, 0.26f, 0.15f}), 0.06f);
    return d;
}

// Signed distance to a polygon (x, y pairs).
static float polygon(float x, float y, std::initializer_list<std::pair<float, float>> points) {
    float d = 1e9f, sign = 1;
    auto a = points.end() - 1;
    for (auto b = points.begin(); b != points.end(); a = b++) {
        const float ex = a->first - b->first, ey = a->second - b->second, wx = x - b->first, wy = y - b->second;
        const float t = clamp((wx * ex + wy * ey) / (ex * ex + ey * ey));
        d = std::min(d, std::hypot(wx - t * ex, wy - t * ey));
        if ((y >= b->second) != (y >= a->second) && (wx < ex * wy / ey)) sign = -sign;
    }
    return sign * d;
}

static float neckAndChest(V p) {
    p.y -= 0.24f;
    float d = capsule(p, {0, -1.0f, -0.22f}, {0, -1.9f, -0.36f}, 0.40f, 0.43f);
    d = smin(d, ellipsoid(p, {0, -2.75f, -0.45f}, {1.35f, 0.98f, 0.62f}), 0.35f);
    const float x = std::fabs(p.x);
    d = smin(d, capsule({x, p.y, p.z}, {0.2f, -1.85f, -0.5f}, {1.33f, -2.42f, -0.52f}, 0.26f, 0.40f), 0.3f);
    d = smin(d, capsule({x, p.y, p.z}, {0.36f, -0.9f, -0.28f}, {0.16f, -1.93f, 0.02f}, 0.06f, 0.06f), 0.11f);
    return smin(d, capsule({x, p.y, p.z}, {0.17f, -1.98f, 0.05f}, {0.75f, -1.9f, -0.1f}, 0.05f, 0.05f), 0.11f);
}

static float hairMass(V p) {  // dark filling under the strands; head space
    float d = ellipsoid(p, {0, 0.36f, -0.10f}, {0.86f, 0.90f, 1.04f});
    const float x = std::fabs(p.x);
    d = smin(d, ellipsoid({x, p.y, p.z}, {0.60f, -0.42f, -0.22f}, {0.30f, 0.82f, 0.52f}), 0.25f);
    // Clear the face: an oval window, open to the front.
    const float part = p.x - 0.2f;
    const float top = 0.70f + 0.08f * std::exp(-part * part * 20) - 0.25f * p.x * p.x;
    const float q = ellipsoid({p.x, p.y > 0 ? p.y * 0.85f / top : p.y, 0}, {0, -0.15f, 0}, {0.66f, 1.0f, 1});
    d = smax(d, std::min(0.9f, -std::max(q, 0.02f - p.z)), 0.12f);
    d = scut(d, ellipsoid(p, {0, -1.2f, 0.35f}, {0.52f, 0.9f, 0.7f}), 0.15f);
    return d;
}

float map(V w, int* material) {
    const V p = toHead(w), s{std::fabs(p.x), p.y, p.z};
    float best = 1e9f;
    int m = Skin;
    const auto join = [&](float d, int id) {
        if (d < best) {
            best = d;
            m = id;
        }
    };
    const float ball = length(p - V{0, -0.1f, 0}) - 1.5f;
    float skin = neckAndChest(w);
    if (ball < 0.3f) {
        skin = smin(skin, face(s), 0.10f);
        join(length(s - kEye) - kEyeR, Eye);
        join(hairMass(p), HairMass);
    } else {
        join(ball, HairMass);
    }
    join(skin, Skin);
    // Clothes, cut out as polygons seen from the front: shirt, its collar, coat, lapels.
    const float body = neckAndChest(w), x = std::fabs(w.x + 0.02f), front = -0.3f - w.z;
    if (body < 0.4f && w.y < -1.1f) {
        const float folds = 0.02f * noise({w.x * 4 + w.y * 2, w.y * 2.5f, w.z * 3});
        const float nape = w.y + 1.36f - 0.25f * (-0.35f - w.z);
        const float vee =
            polygon(x, w.y, {{-0.3f, -2.35f}, {0, -2.35f}, {0.42f, -1.45f}, {0.3f, -1.1f}, {-0.3f, -1.1f}});
        join(std::max({body - 0.03f - folds * 0.4f, front < 0 ? -vee : nape, nape}) * 0.8f, Shirt);
        join(std::max({body - 0.075f, front - 0.35f,
                       polygon(x, w.y, {{0.38f, -1.36f}, {0.09f, -2.00f}, {0.34f, -2.19f}, {0.70f, -1.66f}})}) *
                     0.7f -
                 0.008f,
             Shirt);
        const float opening =
            polygon(x, w.y, {{-0.3f, -2.72f}, {0, -2.72f}, {0.60f, -1.56f}, {0.3f, -1.1f}, {-0.3f, -1.1f}});
        join(std::max({body - 0.09f - folds, front < 0 ? -opening : nape - 0.02f, nape - 0.02f}) * 0.8f, Coat);
        join(std::max({body - 0.14f - folds * 0.7f, front,
                       polygon(x, w.y,
                               {{0.52f, -1.68f},
                                {0.11f, -2.5f},
                                {0.52f, -2.6f},
                                {0.88f, -2.20f},
                                {0.74f, -2.12f},
                                {0.93f, -2.04f},
                                {0.70f, -1.62f}})}) *
                     0.7f -
                 0.008f,
             Coat);
    }
    if (material) *material = m;
    return best;
}

static const V kKey = norm({-0.62f, 0.62f, 0.62f}), kRim = norm({0.85f, 0.35f, -0.35f});
static const V kEyePos{0, -0.15f, 10.5f};

static V shadeHit(V p, V d, int m) {
    V n = normalAt(p);
    const V h = toHead(p), s{std::fabs(h.x), h.y, h.z};
    V albedo{0.8f, 0.8f, 0.8f};
    float gloss = 0, power = 20, wrap = 0;
    if (m == Skin) {
        albedo = V{0.80f, 0.56f, 0.44f};
        const float cheek = std::exp(-(std::pow(s.x - 0.40f, 2.f) + std::pow(s.y + 0.33f, 2.f)) / 0.035f);
        albedo = mix(albedo, {0.78f, 0.42f, 0.34f}, h.z > 0 ? 0.5f * cheek : 0);
        albedo = albedo * (1 + 0.05f * fbm(h * 14, 3));
        const float lips = lipMask(s);
        albedo = mix(albedo, V{0.46f, 0.12f, 0.11f}, 0.9f * lips);
        const V e = s - kEye;
        const float open = lidOpening(e.x, e.y);
        if (h.z > 0.5f && length(e) < 0.3f) {  // lash line and shaded lids
            albedo = mix(albedo, V{0.42f, 0.24f, 0.20f}, 0.6f * smoothstep(0.09f, 0.02f, open));
            if (e.y - 0.1f * e.x > 0)
                albedo = mix(albedo, V{0.03f, 0.02f, 0.02f}, smoothstep(0.022f, 0.008f, open));
            else
                albedo = mix(albedo, V{0.12f, 0.07f, 0.06f}, 0.7f * smoothstep(0.012f, 0.004f, open));
        }
        if (s.x < 0.1f && h.z > 0.9f && std::fabs(h.y + 0.43f) < 0.04f)  // nostril
            albedo = mix(
                albedo, V{0.12f, 0.05f, 0.04f},
                smoothstep(1.1f, 0.8f, length((s - V{0.052f, -0.425f, 1.01f}) * V{1 / .030f, 1 / .03f, 1 / .055f})));
        gloss = 0.10f + 0.30f * lips;
        power = lips > 0.5f ? 40.f : 14.f;
        wrap = 0.25f;
    } else if (m == Eye) {
        const V c = toWorld({h.x < 0 ? -kEye.x : kEye.x, kEye.y, kEye.z});
        const V gaze = norm(kEyePos + V{-1.0f, 0.2f, 0} - c);
        const V o = norm(p - c);
        const float a = std::acos(clamp(dot(o, gaze), -1, 1)) * kEyeR;
        albedo = V{0.86f, 0.84f, 0.82f};
        const float ray = noise(norm(o - gaze * dot(o, gaze)) * 14);
        const V iris = mix(V{0.16f, 0.20f, 0.19f}, V{0.34f, 0.36f, 0.30f}, clamp(0.5f + 0.5f * ray)) *
                       (0.70f + 6 * std::max(0.085f - a, 0.f));
        albedo = mix(albedo, iris, smoothstep(0.096f, 0.088f, a));
        albedo = mix(albedo, V{0.03f, 0.03f, 0.03f}, 0.85f * smoothstep(0.012f, 0.004f, std::fabs(a - 0.088f)));
        albedo = mix(albedo, V{0.005f, 0.005f, 0.005f}, smoothstep(0.042f, 0.036f, a));
        const float glint = length(o - norm(gaze + V{-0.16f, 0.17f, 0.05f}));
        if (glint < 0.10f) return V{1, 1, 1} * 1.2f;
        n = norm(mix(n, gaze, 0.35f));
        gloss = 0.2f;
        power = 60;
        wrap = 0.3f;
    } else if (m == HairMass) {
        albedo = V{0.045f, 0.030f, 0.022f};
    } else if (m == Coat) {
        const float weave = noise({p.x * 60 + p.y * 60, p.y * 60 - p.x * 60, p.z * 40});
        albedo = V{0.022f, 0.025f, 0.033f} * (1 + 0.35f * weave);
        gloss = 0.03f;
        power = 8;
    } else {
        albedo = V{0.86f, 0.86f, 0.88f};
    }
    const float shadow = softShadow(p + n * 0.012f, kKey, 5.5f, 3.0f), ao = occlusion(p, n, 0.35f);
    const float key = clamp((dot(n, kKey) + wrap) / (1 + wrap)) * shadow;
    const float sky = (0.6f + 0.4f * n.y) * ao, fill = clamp(dot(n, norm({0.6f, 0.1f, 0.8f}))) * ao;
    const float rim = m == HairMass ? 0 : clamp(dot(n, kRim)) * ao;
    V light =
        V{1.0f, 0.95f, 0.88f} * (1.15f * key) + V{0.75f, 0.82f, 1.0f} * (0.11f * sky + 0.08f * fill + 0.16f * rim);
    if (m == Skin) light = light + V{0.05f, 0.015f, 0.008f} * (shadow * (1 - key));
    const V half = norm(kKey - d);
    const float fresnel = 0.5f + 1.5f * std::pow(1 - clamp(-dot(n, d)), 4.f);
    return albedo * light + V{1, 1, 1} * (gloss * fresnel * shadow * std::pow(clamp(dot(n, half)), power));
}

// One hair strand as strokes. tint changes its lightness; inner strands are darker.
static void strand(std::vector<Stroke>& out, const std::vector<V>& pts, float px, float tint, float depth) {
    for (size_t i = 0; i + 1 < pts.size(); ++i) {
        const V a = toWorld(pts[i]), b = toWorld(pts[i + 1]), t = norm(b - a);
        const V q = pts[i], c{q.x * 0.15f, q.y > 0.3f ? 0.3f : q.y, -0.1f};
        const V n = norm(toWorld(norm(q - c))), view = norm(kEyePos - a);
        const float tl = dot(t, kKey), sinL = std::sqrt(1 - tl * tl);
        const float facing = clamp(0.25f + 0.85f * dot(n, kKey));
        const V half = norm(kKey + view + n * 0.2f);
        const float th = dot(t, half), spec = std::pow(std::sqrt(std::max(1 - th * th, 0.f)), 36.f);
        const float rim = std::pow(clamp(dot(n, kRim)), 2.f);
        const V base = V{0.066f, 0.040f, 0.026f} * tint;
        V col = base * (0.25f + 1.1f * sinL * facing) + V{0.46f, 0.33f, 0.22f} * (1.1f * spec * facing * tint) +
                V{0.06f, 0.05f, 0.05f} * (0.4f * rim);
        col = col * mix(0.35f, 1, depth);
        const float taper = clamp(4 * (1 - float(i) / float(pts.size())), 0.3f, 1);
        out.push_back({a, b, col, px * taper, clamp(0.1f + 0.15f * float(i), 0, 0.85f), 0.02f});
    }
}

// Hair grows from above the hairline and slides down the surface of hairMass.
static void growHair(std::vector<Stroke>& out, float px) {
    Random rnd{7};
    const auto gradient = [](V p) {
        const float e = 0.01f, d = hairMass(p);
        return norm(V{hairMass(p + V{e, 0, 0}) - d, hairMass(p + V{0, e, 0}) - d, hairMass(p + V{0, 0, e}) - d});
    };
    for (int g = 0; g < 700; ++g) {
        const float th = rnd(0, 6.28318f), up = rnd(0.05f, 1.f), el = std::asin(up);
        const V root = V{std::sin(th) * std::cos(el), up, std::cos(th) * std::cos(el)};
        const float line = root.z > 0 ? mix(0.20f, 0.33f, smoothstep(0.1f, 0.6f, root.z)) : 0.1f;
        if (up < line) continue;
        const float layer = rnd(), part = root.x - 0.22f, side = part > 0 ? 1.f : -1.f;
        const float phase = rnd(0, 6.28f), tall = rnd(-1.38f, -1.15f), shade = rnd(0.5f, 1.5f);
        for (int k = 0; k < 24; ++k) {
            const V j{rnd(-1, 1), rnd(-1, 1), rnd(-1, 1)};
            const float thick = 0.01f + 0.09f * layer + 0.02f * rnd(), end = tall + 0.06f * j.y;
            V p = V{0, 0.36f, -0.10f} + norm(root + j * 0.07f) * V{0.87f, 0.91f, 1.05f};
            V dir =
                norm(V{side, 0.35f, root.z > 0.1f ? 0.30f - 0.45f * smoothstep(0.15f, 0.45f, std::fabs(part)) : -0.2f});
            std::vector<V> pts{p};
            bool kinked = false;
            for (int i = 0; i < 90 && p.y > end; ++i) {
                const V n = gradient(p);
                const float wave = 0.045f * std::sin(phase + p.y * 6.5f) * smoothstep(0.4f, -0.4f, p.y);
                dir = norm(dir + V{0, -0.13f, -0.02f});
                if (p.y > -0.95f) {
                    p = p - n * clamp(0.6f * (hairMass(p) - thick * smoothstep(0, 5, float(i)) - wave), -0.04f, 0.04f);
                    dir = norm(dir - n * dot(dir, n));
                } else {  // the ends turn in
                    dir = norm(dir + V{p.x > 0 ? -0.10f : 0.10f, 0, 0});
                }
                p = p + dir * 0.04f + j * (k == 0 ? 0.005f : 0.0012f);
                pts.push_back(p);
                const size_t q = pts.size();
                if (q > 2 && dot(norm(pts[q - 1] - pts[q - 2]), norm(pts[q - 2] - pts[q - 3])) < 0.45f) kinked = true;
            }
            if (!kinked) strand(out, pts, px, shade * rnd(0.7f, 1.3f), layer);
        }
    }
    // Brows and lashes.
    for (int sgn = -1; sgn <= 1; sgn += 2) {
        for (int i = 0; i < 400; ++i) {
            const float t = rnd(), u = mix(0.10f, 0.54f, t), v = 0.205f + 0.075f * std::sin(t * 2.1f) - 0.05f * t * t;
            const float hw = mix(0.036f, 0.010f, t);
            V a{sgn * u, v + rnd(-hw, hw), 1.1f};
            V b{sgn * (u + rnd(0.03f, 0.06f)), a.y + mix(0.035f, -0.015f, t), 1.1f};
            for (V* p : {&a, &b})
                for (int k = 0; k < 40; ++k) p->z -= 0.8f * std::max(face({std::fabs(p->x), p->y, p->z}) - 0.006f, 0.f);
            out.push_back(
                {toWorld(a), toWorld(b), V{0.035f, 0.022f, 0.016f} * rnd(0.7f, 1.6f), px * 1.1f, 0.8f, 0.03f});
        }
        for (int i = 0; i < 60; ++i) {
            const float u = mix(-0.14f, 0.175f, rnd()), t = u / 0.175f;
            const float v = 0.069f * (1 - t * t) * (1 - 0.15f * t) + 0.10f * u;
            const V a{sgn * (kEye.x + u), v, kEye.z + std::sqrt(std::max(0.0529f - u * u - v * v, 0.01f))};
            const V b = a + V{sgn * (0.01f + 0.16f * u), 0.020f + 0.012f * t, 0.035f} * rnd(0.8f, 1.2f);
            out.push_back({toWorld(a), toWorld(b), {0.012f, 0.009f, 0.008f}, px * 1.2f, 0.8f, 0.05f});
        }
    }
}

int main(int argc, char** argv) {
    const int w = 2 * (argc > 1 ? std::atoi(argv[1]) : 768), h = w * 5 / 4;
    Picture pic(w, h);
    const Camera cam(kEyePos, {0.02f, -0.26f, 0}, 20.8f, w, h);
    render(pic, cam, 8, 14, shadeHit, [](float x, float y) {  // a light wall, darker to the corners
        const float r = std::hypot(x - 0.62f, (y - 0.42f) * 1.1f);
        const V p{x * 5, y * 6, 3};
        return V{0.80f, 0.79f, 0.76f} * (0.92f - 0.75f * r * r + 0.05f * fbm(p, 4));
    });
    std::vector<Stroke> strokes;
    growHair(strokes, std::max(float(w) / 900.f, 0.6f));
    drawStrokes(pic, cam, strokes);
    writeHalf(pic, stdout);
}
