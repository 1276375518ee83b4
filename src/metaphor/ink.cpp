// Plain ink: the papers' own figures (004 figs. 2, 6, 7, 8).
#include "metaphor/ink_layer.h"

namespace dstylize {
namespace {

class Ink final : public Metaphor {
  public:
    void visit(ParameterVisitor& visitor) override { ink_.visit(visitor); }
    DisplayList draw(const Subject& subject) const override { return ink_on_paper(subject, ink_); }

  private:
    InkParameters ink_{{0x0f / 255.0f, 0x0f / 255.0f, 0x12 / 255.0f, 1}, {1, 1, 1, 1}, 0};
};

}  // namespace

std::unique_ptr<Metaphor> make_ink() { return std::make_unique<Ink>(); }

}  // namespace dstylize
