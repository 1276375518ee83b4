#include "ipc/codec_protocol.h"

#include <algorithm>

namespace dstylize::ipc {

std::string packed_text(const MetadataText& text) {
    std::string block;
    const auto append = [&](const std::string& part) {
        std::copy_if(part.begin(), part.end(), std::back_inserter(block), [](char c) { return c != '\0'; });
        block += '\0';
    };
    for (const auto& [key, value] : text) {
        append(key);
        append(value);
    }
    return block;
}

MetadataText unpacked_text(const std::string& block) {
    MetadataText text;
    std::size_t begin = 0;
    while (true) {
        const std::size_t key_end = block.find('\0', begin);
        if (key_end == std::string::npos) break;
        const std::size_t value_end = block.find('\0', key_end + 1);
        if (value_end == std::string::npos) break;
        text.emplace_back(block.substr(begin, key_end - begin), block.substr(key_end + 1, value_end - key_end - 1));
        begin = value_end + 1;
    }
    return text;
}

}  // namespace dstylize::ipc
