// Ink tendrils with leaves where the picture is calm (004 s. 4.5, fig. 9 left).
#include "metaphor/ink_layer.h"
#include "metaphor/leaves.h"

namespace dstylize {
namespace {

class Vine final : public Metaphor {
  public:
    void visit(ParameterVisitor& visitor) override {
        ink_.visit(visitor);
        leaves_.visit(visitor);
    }
    DisplayList draw(const Subject& subject) const override {
        DisplayList list = ink_on_paper(subject, ink_);
        add_leaf_layers(list, placed_leaves(subject, leaves_), leaves_, ink_.ink, subject.u_px);
        return list;
    }

  private:
    InkParameters ink_;
    LeafParameters leaves_;
};

}  // namespace

std::unique_ptr<Metaphor> make_vine() { return std::make_unique<Vine>(); }

}  // namespace dstylize
