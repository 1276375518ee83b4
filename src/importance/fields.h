#pragma once
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>

#include "core/grid.h"
#include "core/parameters.h"
#include "core/picture.h"
#include "core/vec.h"

namespace dstylize {

/// The shape that a drawing keeps to and how far the picture leads inside: the [crown] table. Places and
/// sizes are shares of the frame's sides.
struct CrownParameters {
    bool shaped = false;  ///< else the whole frame
    float x = 0.5f, y = 0.42f, width = 0.96f, height = 0.8f;
    float power = 2.6f, lobes = 0.1f, soft = 0.12f;
    float likeness = 1;
    float free_side = 0, free_ramp = 0.3f;
    float free_tone = 0.34f, free_scale = 70;

    void visit(ParameterVisitor& visitor);
};

/// How the fields are read off a picture: the [fields] table of a style. Lengths in u.
struct FieldParameters {
    float stretch_low = 2, stretch_high = 98;
    bool bright = false;
    float tone_contrast = 0;
    float tone_equalise = 0.4f, tone_white = 0.12f, tone_black = 0.90f;
    float tone_local = 0, tone_local_scale = 140;
    float gradient_scale = 1.2f, gradient_wide_scale = 3, gradient_wide_share = 0.8f;
    float gradient_percentile = 97, gradient_gamma = 0.8f, gradient_tone = 0;
    float line_scale = 1.5f;
    float importance_gradient = 3, importance_tone = 1, importance_lines = 2, importance_percentile = 98.5f;
    float features_gradient = 0.8f, features_surround = 12, features_suppress = 0.6f;
    float avoid_scale = 6, avoid_level = 0.95f;
    float border_width = 24;
    float smooth_noise_scale = 3;
    float flow_fine = 6, flow_coarse = 28, flow_coarse_share = 0.5f, flow_swirl = 0.25f;
    float shape_overflow = 0, shape_ragged = 0, shape_ragged_scale = 12;
    float axis_width = 18, rim_width = 3;
    float calm_scale = 45, calm_detail = 0.13f, calm_tone = 0.45f;
    CrownParameters crown;  ///< a table of its own in style files

    void visit(ParameterVisitor& visitor);
};

/// What a user gives beside the picture; each at the lattice's extent, values in [0, 1].
struct UserMaps {
    std::optional<Grid<float>> importance;
    bool importance_replaces = false;  ///< else the map is multiplied in
    std::optional<Grid<float>> mask;
    bool no_picture = false;  ///< nothing leads: what can be drawn without a picture is
};

/// The half width at which the field `room` is 1.
inline constexpr float kRoom_u = 64;

/// Local orientation of the picture: a unit direction along its structures times the coherence in
/// [0, 1] (0: no preferred direction). Sign means nothing.
using FlowField = Grid<Vec2f>;

/// Everything that a style can read off a picture, by name, computed when first asked for. One
/// instance belongs to one thread.
class Fields {
  public:
    /// `luma`: the picture's luma in [0, 1] at the lattice's extent. `nodes_per_u`: without it
    /// extent.long_side() / 1024.
    Fields(Grid<float> luma, FieldParameters parameters, UserMaps maps, std::uint64_t seed,
           std::optional<float> nodes_per_u = {});

    Extent extent() const { return luma_.extent(); }
    /// Nodes per u.
    float u() const { return u_; }
    const FieldParameters& parameters() const { return parameters_; }
    const UserMaps& maps() const { return maps_; }
    std::uint64_t seed() const { return seed_; }

    /// The field called `name`. Throws Error(bad_usage) naming the nearest for an unknown one.
    const Grid<float>& operator[](std::string_view name);
    const FlowField& flow();
    /// The medial axis of the mask, or without one of the picture's dark parts: 1 on it.
    const Grid<std::uint8_t>& shape_axis();
    /// Nodes where growth in the shape may go: the mask, grown by the overflow and made ragged; parts that
    /// are separate in the mask stay so. Without a mask: of the picture's dark parts.
    const Grid<std::uint8_t>& shape_interior();
    /// Puts another field in the place of the one called `name`: `lacking` changes as a drawing grows.
    void replace(std::string_view name, Grid<float> field);

    /// Forgets those fields; who asks for one gets it anew.
    void release(std::span<const std::string_view> names);

    /// Takes over what `other`, the same picture with the same parameters and another seed, has computed so far
    /// of the fields that no chance enters.
    void share(const Fields& other);

    static std::span<const std::string_view> names();
    static std::string_view meaning(std::string_view name);

    const Grid<float>& source_luma() const { return luma_; }

  private:
    static constexpr int kEach[] = {
#define DSTYLIZE_FIELD(name, function, meaning) 0,
#include "importance/fields.def"
#undef DSTYLIZE_FIELD
    };
    static constexpr std::size_t kCount = std::size(kEach);
    Grid<float> luma_;
    FieldParameters parameters_;
    UserMaps maps_;
    std::uint64_t seed_;
    float u_;
    std::array<std::optional<Grid<float>>, kCount> cache_;
    std::optional<FlowField> flow_;
    std::optional<Grid<std::uint8_t>> shape_axis_, shape_interior_;
};

}  // namespace dstylize
