#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/picture.h"

namespace dstylize {

/// One user-settable value: its key in a style file, its unit ("" for a ratio; "u" is 1/1024 of the
/// picture's long side) and, in one line, what turning it does.
struct ParameterDoc {
    std::string_view key, unit, meaning;
};

/// A weighted sum of fields, by name: what a cost or a density is made of.
using FieldWeights = std::vector<std::pair<std::string, float>>;

/// Every part that has parameters shows each of them once, in a member function
/// `void visit(ParameterVisitor&)`. The style reader and writer, `styles NAME`, `--set` and the fuzzer
/// are visitors, so a parameter is declared in one line.
class ParameterVisitor {
  public:
    virtual ~ParameterVisitor() = default;
    virtual void number(ParameterDoc doc, float& value, float lo, float hi) = 0;
    virtual void integer(ParameterDoc doc, int& value, int lo, int hi) = 0;
    virtual void flag(ParameterDoc doc, bool& value) = 0;
    /// `value` is an index into `names`.
    virtual void choice(ParameterDoc doc, int& value, std::span<const std::string_view> names) = 0;
    virtual void colour(ParameterDoc doc, Rgba& value) = 0;
    virtual void text(ParameterDoc doc, std::string& value) = 0;
    /// Weights of named fields: a table in the style file, kept in the order of `names`.
    virtual void field_weights(ParameterDoc doc, FieldWeights& value) = 0;
    /// A table of its own inside the current one.
    virtual void section(std::string_view key, std::string_view meaning,
                         const std::function<void(ParameterVisitor&)>& visit) = 0;
};

/// `choice` for an enum whose values are 0, 1, 2, … in the order of `names`.
template <class Enum>
void choice(ParameterVisitor& visitor, ParameterDoc doc, Enum& value, std::span<const std::string_view> names) {
    int i = static_cast<int>(value);
    visitor.choice(doc, i, names);
    value = static_cast<Enum>(i);
}

}  // namespace dstylize
