#pragma once
#include <vector>

#include "core/branching.h"
#include "core/grid.h"
#include "core/parameters.h"
#include "stroke/pipe.h"

namespace dstylize {

/// How wide the strokes are: the [width] table of a style. Lengths in u. The rules are blended by their
/// weights: tone (wanted tone / line density, ours), importance (004 s. 4.3), branch (pipe model: a share of
/// all tips), tips (pipe model: as many times the narrowest), constant, fields (any weighted sum of fields),
/// piped (pipe model by width, pipe.h), path (V / T, V = exp(-alpha (c T)^2) of the path cost c, 000 s. 4.3).
struct WidthParameters {
    float tone = 1, importance = 0, branch = 0, tips = 0, constant = 0, field = 0, path = 0, piped = 0;
    float narrowest = 0.45f, widest = 4.2f;
    float constant_width = 1.4f;
    float tone_gamma = 1.8f, tone_most = 0.86f, tone_lines = 0.3f;
    int feedback = 3;
    float importance_gamma = 1.5f;
    FieldWeights fields;
    float field_gamma = 1.3f;
    float path_alpha = 6, path_side = 1.6f;
    float branch_exponent = 0.42f, tips_exponent = 0.36f;
    float room_share = 0;
    float trunk = 7, trunk_least_tone = 0.3f;
    float window = 9;
    float tip = 14, tip_width = 0.45f;
    float swing = 0;  ///< twigs are wider where ink is wanted, thinner where it is not
    float wanted_gain = 1.3f;
    PipeParameters pipe;

    /// Whether widths follow the ink that is wanted.
    bool wants_ink() const { return tone > 0 || swing > 0; }
    void visit(ParameterVisitor& visitor);
};

/// The fields that widths look at, at the lattice's extent, values in [0, 1].
struct WidthFields {
    const Grid<float>* tone;  ///< needed when ink is wanted (WidthParameters::wants_ink) or for a trunk
    const Grid<float>& importance;
    const Grid<float>* lines = nullptr;       ///< needed when ink is wanted (WidthParameters::wants_ink)
    const Grid<float>* sum = nullptr;         ///< of WidthParameters::fields; needed when `field` weighs
    const Grid<float>* node_cost = nullptr;   ///< per unit of length, any scale; needed when `path` weighs
    const Grid<float>* half_width = nullptr;  ///< lattice steps: of the shape around; null: no limit
    const Grid<float>* guided = nullptr;      ///< how far `swing` may go; null: 1 everywhere
};

/// Widths of a dendrite's nodes, in lattice steps. Use: construct, read `widths()`, draw, compare the
/// drawn ink with `target_ink()`, `correct()`, and again.
class Widths {
  public:
    /// `u`: lattice steps per u. References must outlive this object.
    Widths(const Dendrite& dendrite, const Branching& branching, const WidthParameters& parameters,
           const WidthFields& fields, float u);

    /// One full width per node, after rolling mean, trunk floor, junction caps and tip taper.
    const std::vector<float>& widths() const { return widths_; }
    /// Share of the area that should be inked, per node; empty where no ink is wanted.
    const Grid<float>& target_ink() const { return target_ink_; }
    /// Multiplies the raw widths by target / drawn (both blurred by the caller) at each node, by at
    /// most `kMostCorrection` either way, and finishes them anew.
    void correct(const Grid<float>& blurred_target, const Grid<float>& blurred_drawn);

    static constexpr float kMostCorrection = 1.6f;

  private:
    void follow_paths();
    float raw_width(std::uint32_t v, float tone_width) const;
    float swing(std::uint32_t v, float width) const;
    void finish();
    template <class F>
    void each_branch(F f) const;
    void roll(std::vector<float>& values) const;
    std::vector<float> trunk_widths() const;
    void raise_trunk();
    void cap_at_junctions();
    void taper_tips();

    const Dendrite& dendrite_;
    const Branching& branching_;
    WidthParameters parameters_;
    WidthFields fields_;
    float u_;
    Grid<float> target_ink_;
    std::vector<float> path_share_;  ///< V of every node, empty when no width follows it
    std::vector<float> pipe_;        ///< empty without the pipe rule
    std::vector<float> trunk_;       ///< least width of every node, empty without a trunk
    std::vector<float> raw_, widths_;
};

}  // namespace dstylize
