#include <array>
#include <string>

#include "core/error.h"
#include "metaphor/metaphor.h"

namespace dstylize {

#define DSTYLIZE_METAPHOR(name) std::unique_ptr<Metaphor> make_##name();
#include "metaphor/metaphors.def"
#undef DSTYLIZE_METAPHOR

namespace {
struct Row {
    std::string_view name;
    std::unique_ptr<Metaphor> (*make)();
};
constexpr Row kRows[] = {
#define DSTYLIZE_METAPHOR(name) {#name, &make_##name},
#include "metaphor/metaphors.def"
#undef DSTYLIZE_METAPHOR
};
constexpr auto kNames = [] {
    std::array<std::string_view, std::size(kRows)> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = kRows[i].name;
    return names;
}();
}  // namespace

std::unique_ptr<Metaphor> make_metaphor(std::string_view name) {
    std::string known;
    for (const Row& row : kRows) {
        if (row.name == name) return row.make();
        known += (known.empty() ? "" : ", ") + std::string(row.name);
    }
    throw Error(ErrorCode::bad_usage, "", "no metaphor is called '" + std::string(name) + "'", "use one of " + known);
}
std::span<const std::string_view> metaphor_names() { return kNames; }

}  // namespace dstylize
