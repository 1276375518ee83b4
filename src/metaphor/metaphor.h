#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "core/display_list.h"
#include "core/grid.h"
#include "core/parameters.h"

namespace dstylize {

/// What a metaphor may look at. It changes nothing.
struct Subject {
    float width_px = 0, height_px = 0;        ///< the picture frame
    float u_px = 1;                           ///< 1/1024 of its long side
    float px_per_node = 1;                    ///< scale of the fields
    std::span<const VariableStroke> strokes;  ///< centrelines and widths; parents before children
    /// A field of the picture by name, on the lattice.
    std::function<const Grid<float>&(std::string_view)> field;
    std::uint64_t seed = 0;
    const Picture* picture = nullptr;  ///< the input itself, at its own size; never null in a drawing
    /// Beside `strokes`, one value per point: the share of all tips that hang on it, in (0, 1].
    std::span<const std::vector<float>> tip_share = {};
    /// Where the picture lies in the frame: its upper left corner, and its size as a share of the frame's.
    Vec2f picture_corner_px = {};
    float picture_scale = 1;
    bool no_picture = false;  ///< nothing but the picture's size counts
};

/// How a dendrite is dressed: ink, vine, later lightning, lichen, bark. Its parameters are the table
/// of its own name in a style file. It knows nothing of planning.
class Metaphor {
  public:
    virtual ~Metaphor() = default;
    virtual void visit(ParameterVisitor& visitor) = 0;
    virtual DisplayList draw(const Subject& subject) const = 0;
};

/// Throws Error(bad_usage) for an unknown name, listing the known ones.
std::unique_ptr<Metaphor> make_metaphor(std::string_view name);
std::span<const std::string_view> metaphor_names();

}  // namespace dstylize
