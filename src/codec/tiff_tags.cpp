#include "codec/tiff_tags.h"

#include <algorithm>
#include <cmath>

namespace dstylize::codec {
namespace {

/// Bytes of one value; 0 for an unknown type.
int value_bytes(std::uint16_t type) {
    constexpr int kBytes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8};
    return type < std::size(kBytes) ? kBytes[type] : 0;
}

TiffTag number_tag(TiffTagId id, TiffType type, std::initializer_list<std::uint32_t> numbers) {
    TiffTag tag{id, type, 1, {}, 0};
    for (const std::uint32_t number : numbers)
        append_integer(tag.value, number, type == TiffType::short_integer ? 2 : 4, Endian::little);
    return tag;
}

}  // namespace

const TiffTag* TiffDirectory::find(TiffTagId id) const {
    const auto found = std::ranges::find(tags, id, &TiffTag::id);
    return found == tags.end() ? nullptr : &*found;
}

std::optional<std::uint32_t> TiffDirectory::integer(TiffTagId id) const {
    const TiffTag* tag = find(id);
    if (!tag || tag->count == 0) return std::nullopt;
    switch (tag->type) {
        case TiffType::byte: return std::uint32_t(integer_at(bytes_of(tag->value), 0, 1, endian));
        case TiffType::short_integer: return std::uint32_t(integer_at(bytes_of(tag->value), 0, 2, endian));
        case TiffType::long_integer: return std::uint32_t(integer_at(bytes_of(tag->value), 0, 4, endian));
        default: return std::nullopt;
    }
}

double TiffDirectory::dpi() const {
    const TiffTag* resolution = find(TiffTagId::x_resolution);
    if (!resolution || resolution->type != TiffType::rational || resolution->count == 0) return 0;
    const Bytes value = bytes_of(resolution->value);
    const double numerator = double(integer_at(value, 0, 4, endian)),
                 denominator = double(integer_at(value, 4, 4, endian));
    if (denominator == 0) return 0;
    switch (integer(TiffTagId::resolution_unit).value_or(2)) {
        case 2: return numerator / denominator;
        case 3: return numerator / denominator * 2.54;
        default: return 0;
    }
}

std::optional<TiffDirectory> first_directory(Bytes tiff) {
    const bool little = starts_with(tiff, std::string_view("II*\0", 4));
    if (!little && !starts_with(tiff, std::string_view("MM\0*", 4))) return std::nullopt;
    TiffDirectory directory;
    directory.endian = little ? Endian::little : Endian::big;
    const auto number = [&](std::size_t offset, int size) { return integer_at(tiff, offset, size, directory.endian); };
    const std::size_t start = number(4, 4);
    const std::size_t count = number(start, 2);
    if (start < 8 || part(tiff, start + 2).size() < count * 12) return std::nullopt;
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t entry = start + 2 + n * 12;
        const auto type = std::uint16_t(number(entry + 2, 2));
        const auto values = std::uint32_t(number(entry + 4, 4));
        const std::uint64_t size = std::uint64_t(values) * std::uint64_t(value_bytes(type));
        const Bytes value = part(tiff, size <= 4 ? entry + 8 : number(entry + 8, 4), size);
        if (size == 0 || value.size() < size) continue;
        directory.tags.push_back(
            {TiffTagId(number(entry, 2)), TiffType(type), values, std::string(text_of(value)), entry});
    }
    return directory;
}

TiffTag ascii_tag(TiffTagId id, const std::string& text) {
    return {id, TiffType::ascii, std::uint32_t(text.size() + 1), text + '\0', 0};
}

TiffTag bytes_tag(TiffTagId id, TiffType type, const std::string& bytes) {
    return {id, type, std::uint32_t(bytes.size()), bytes, 0};
}

std::vector<TiffTag> resolution_tags(double dpi) {
    const auto hundredths = std::uint32_t(std::lround(std::clamp(dpi, 0.01, 1e6) * 100));
    return {number_tag(TiffTagId::x_resolution, TiffType::rational, {hundredths, 100}),
            number_tag(TiffTagId::y_resolution, TiffType::rational, {hundredths, 100}),
            number_tag(TiffTagId::resolution_unit, TiffType::short_integer, {2})};
}

void replace_tags(TiffDirectory& directory, const std::vector<TiffTag>& tags) {
    for (const TiffTag& tag : tags) {
        std::erase_if(directory.tags, [&](const TiffTag& old) { return old.id == tag.id; });
        directory.tags.push_back(tag);
    }
}

std::string directory_bytes(const TiffDirectory& directory, std::uint32_t offset) {
    std::vector<TiffTag> tags = directory.tags;
    std::ranges::sort(tags, {}, &TiffTag::id);  // the standard asks for ascending tags
    std::string entries, values;
    const std::size_t values_at = offset + 2 + tags.size() * 12 + 4;
    const auto append = [&](std::uint64_t value, int size) { append_integer(entries, value, size, directory.endian); };
    append(tags.size(), 2);
    for (const TiffTag& tag : tags) {
        append(std::uint64_t(tag.id), 2);
        append(std::uint64_t(tag.type), 2);
        append(tag.count, 4);
        if (tag.value.size() <= 4) {
            std::string value = tag.value;
            value.resize(4);
            entries += value;
        } else {
            append(values_at + values.size(), 4);
            values += tag.value;
            if (values.size() % 2) values += '\0';  // values begin at even offsets
        }
    }
    append(0, 4);  // no further directory
    return entries + values;
}

std::string exif_block(const std::vector<TiffTag>& tags) {
    TiffDirectory directory;
    directory.tags = tags;
    std::string block("II*\0\x08\0\0\0", 8);
    return block + directory_bytes(directory, 8);
}

}  // namespace dstylize::codec
