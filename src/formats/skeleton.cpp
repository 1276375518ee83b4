#include "formats/skeleton.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "formats/detail_vector.h"

namespace dstylize {
namespace {

using nlohmann::json;

constexpr std::string_view kFormatName = "dstylize skeleton";
constexpr int kVersion = 1;
constexpr std::size_t kMostBytes = std::size_t(512) << 20, kMostNodes = std::size_t(1) << 26;
constexpr int kLargestSide = 1 << 20;
constexpr double kLargestWidth_u = 4096;

[[noreturn]] void fail(const std::string& problem) {
    throw Error(ErrorCode::cannot_read, "", "not a usable skeleton: " + problem, "write it again with this program");
}

std::string json_text(std::string_view text) { return json(clean_text(text)).dump(); }

/// Appends `"key": [v0,v1,...]`, one number per index, written by `number`.
template <class Number>
void append_array(std::string& out, std::string_view key, std::size_t count, Number number) {
    out += fmt::format(",\n\"{}\": [", key);
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) out += ',';
        number(i);
    }
    out += ']';
}

/// A multiple of 1/scale without needless digits; scale is a power of ten.
void append_fixed(std::string& out, float value, int digits, double scale) {
    const long long units = std::llround(double(value) * scale);
    const auto size = static_cast<unsigned long long>(std::llabs(units)), step = static_cast<unsigned long long>(scale);
    if (units < 0) out += '-';
    out += fmt::format_int(size / step).c_str();
    if (size % step == 0) return;
    std::string part = fmt::format(".{:0{}}", size % step, digits);
    part.erase(part.find_last_not_of('0') + 1);
    out += part;
}

const json& member(const json& object, const char* key) {
    const auto it = object.find(key);
    if (it == object.end()) fail(fmt::format("\"{}\" is missing", key));
    return *it;
}

std::string text_member(const json& value, const char* what) {
    if (!value.is_string()) fail(fmt::format("{} is not a text", what));
    return value.get<std::string>();
}

long long integer(const json& value, const char* what, long long least, long long most) {
    // A huge unsigned number must not wrap into the range.
    const bool fits = value.is_number_unsigned()
                          ? value.get<std::uint64_t>() <= std::uint64_t(std::numeric_limits<std::int64_t>::max())
                          : value.is_number_integer();
    const long long n = fits ? value.get<long long>() : 0;
    if (!fits || n < least || n > most)
        fail(fmt::format("\"{}\" holds {}, not an integer from {} to {}", what, value.dump().substr(0, 40), least,
                         most));
    return n;
}

double number(const json& value, const char* what, double least, double most) {
    const double n = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(n >= least && n <= most))
        fail(fmt::format("\"{}\" holds {}, not a number from {} to {}", what, value.dump().substr(0, 40), least, most));
    return n;
}

Extent extent(const json& object, const char* key) {
    const json& value = member(object, key);
    if (!value.is_array() || value.size() != 2) fail(fmt::format("\"{}\" is not a pair", key));
    return {int(integer(value[0], key, 1, kLargestSide)), int(integer(value[1], key, 1, kLargestSide))};
}

/// The array of a key, checked for its length.
const json& array(const json& object, const char* key, std::size_t count) {
    const json& value = member(object, key);
    if (!value.is_array() || value.size() != count)
        fail(fmt::format("\"{}\" is not an array of {} entries", key, count));
    return value;
}

Dendrite read_dendrite(const json& object, std::size_t count, Extent lattice) {
    const json &nodes = array(object, "node", count), &x = array(object, "x", count), &y = array(object, "y", count);
    const json &parents = array(object, "parent", count), &owners = array(object, "owner", count);
    const json& stages = array(object, "stage", count);
    Dendrite d;
    for (std::size_t v = 0; v < count; ++v) {
        const auto node = integer(nodes[v], "node", -1, static_cast<long long>(lattice.count()) - 1);
        const auto parent = integer(parents[v], "parent", -1, static_cast<long long>(v) - 1);
        // Strokes may be warped a little out of the picture, not far.
        const Vec2f at{float(number(x[v], "x", -lattice.x, 2.0 * lattice.x)),
                       float(number(y[v], "y", -lattice.y, 2.0 * lattice.y))};
        d.add(
            node < 0 ? kNoNode : NodeId{std::uint32_t(node)}, at, parent < 0 ? Dendrite::kRoot : std::uint32_t(parent),
            std::uint16_t(integer(owners[v], "owner", 0, 0xfffe)), std::uint8_t(integer(stages[v], "stage", 0, 0xff)));
    }
    return d;
}

Skeleton read_object(const json& object) {
    if (!object.is_object()) fail("the outermost value is not an object");
    if (text_member(member(object, "format"), "\"format\"") != kFormatName) fail("it is of another format");
    if (integer(member(object, "version"), "version", 0, 1 << 30) != kVersion) fail("it is of another version");
    Skeleton s;
    s.lattice = extent(object, "lattice");
    s.picture = extent(object, "picture");
    if (s.lattice.count() > std::numeric_limits<std::uint32_t>::max() - 1u) fail("\"lattice\" has too many nodes");
    const json& names = member(object, "stages");
    if (!names.is_array() || names.size() > 256) fail("\"stages\" is not an array of at most 256 names");
    for (const json& name : names) s.stage_names.push_back(text_member(name, "a stage name"));
    const auto count = std::size_t(integer(member(object, "count"), "count", 0, kMostNodes));
    s.dendrite = read_dendrite(object, count, s.lattice);
    if (const std::string fault = first_fault(s.dendrite); !fault.empty()) fail(fault);
    for (const std::uint8_t stage : s.dendrite.stage)
        if (!s.stage_names.empty() && stage >= s.stage_names.size()) fail("a node is of a stage that has no name");
    if (object.contains("width"))
        for (const json& width : array(object, "width", count))
            s.width_u.push_back(float(number(width, "width", 0, kLargestWidth_u)));
    return s;
}

}  // namespace

std::string skeleton_json(const Skeleton& skeleton, const DocumentInfo& info) {
    const Dendrite& d = skeleton.dendrite;
    assert(skeleton.width_u.empty() || skeleton.width_u.size() == d.size());
    std::string out = fmt::format(
        "{{\n\"format\": \"{}\",\n\"version\": {},\n\"lattice\": [{},{}],\n\"picture\": [{},{}],\n\"title\": "
        "{},\n\"info\": {{",
        kFormatName, kVersion, skeleton.lattice.x, skeleton.lattice.y, skeleton.picture.x, skeleton.picture.y,
        json_text(info.title));
    for (std::size_t i = 0; i < info.text.size(); ++i)
        out += fmt::format("{}\n  {}: {}", i > 0 ? "," : "", json_text(info.text[i].first),
                           json_text(info.text[i].second));
    out += "}";
    append_array(out, "stages", skeleton.stage_names.size(),
                 [&](std::size_t i) { out += json_text(skeleton.stage_names[i]); });
    out += fmt::format(",\n\"count\": {}", d.size());
    const auto append_integer = [&](long long n) { out += fmt::format_int(n).c_str(); };
    append_array(out, "node", d.size(), [&](std::size_t v) {
        append_integer(d.node[v] == kNoNode ? -1 : static_cast<long long>(index(d.node[v])));
    });
    append_array(out, "x", d.size(), [&](std::size_t v) { append_fixed(out, d.position_lattice[v].x, 2, 100); });
    append_array(out, "y", d.size(), [&](std::size_t v) { append_fixed(out, d.position_lattice[v].y, 2, 100); });
    append_array(out, "parent", d.size(), [&](std::size_t v) {
        append_integer(d.is_root(std::uint32_t(v)) ? -1 : static_cast<long long>(d.parent[v]));
    });
    append_array(out, "owner", d.size(), [&](std::size_t v) { append_integer(d.owner[v]); });
    append_array(out, "stage", d.size(), [&](std::size_t v) { append_integer(d.stage[v]); });
    if (!skeleton.width_u.empty())
        append_array(out, "width", d.size(), [&](std::size_t v) { append_fixed(out, skeleton.width_u[v], 3, 1000); });
    out += "\n}\n";
    return out;
}

Skeleton read_skeleton_json(std::string_view text) {
    if (text.size() > kMostBytes) fail("it is larger than 512 MB");
    const json object = json::parse(text, nullptr, false);
    if (object.is_discarded()) fail("it is not JSON");
    return read_object(object);
}

}  // namespace dstylize
