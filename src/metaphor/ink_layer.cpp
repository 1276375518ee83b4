#include "metaphor/ink_layer.h"

namespace dstylize {

void InkParameters::visit(ParameterVisitor& v) {
    v.colour({"ink", "", "colour of the strokes"}, ink);
    v.colour({"paper", "", "colour of the ground"}, paper);
    v.number({"grain", "", "lightness noise of the paper, on raster outputs up to 4 megapixels"}, grain, 0, 0.2f);
}

DisplayList ink_on_paper(const Subject& subject, const InkParameters& p) {
    DisplayList list{subject.width_px, subject.height_px, {p.paper, p.grain, subject.seed}, {}};
    Layer strokes{"strokes", Blend::max, {}};
    strokes.items.reserve(subject.strokes.size());
    for (VariableStroke stroke : subject.strokes) {
        stroke.colour = p.ink;
        strokes.items.push_back(std::move(stroke));
    }
    list.layers.push_back(std::move(strokes));
    return list;
}

}  // namespace dstylize
