#include "pipeline/shard.h"

#include <charconv>

#include "core/error.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;

constexpr int kMostShards = 1'000'000;

int number(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

fs::path shard_file(const fs::path& output, Shard shard, const char* extension) {
    return shard_folder(output, shard.count) / (std::to_string(shard.index) + extension);
}

}  // namespace

Shard parsed_shard(const std::string& text) {
    const std::size_t slash = text.find('/');
    Shard shard{0, 0};
    if (slash != std::string::npos)
        shard = {number(std::string_view(text).substr(0, slash)), number(std::string_view(text).substr(slash + 1))};
    if (shard.index < 1 || shard.index > shard.count || shard.count > kMostShards)
        throw Error(ErrorCode::bad_usage, "--shard " + text, "is no share of a run",
                    "write K/N with K from 1 to N, as 3/8");
    return shard;
}

std::vector<std::size_t> shard_entries(Shard shard, std::size_t total) {
    std::vector<std::size_t> out;
    for (std::size_t k = std::size_t(shard.index) - 1; k < total; k += std::size_t(shard.count)) out.push_back(k);
    return out;
}

fs::path shard_folder(const fs::path& output, int count) {
    return output / ".dstylize" / "shards" / std::to_string(count);
}
fs::path shard_ledger(const fs::path& output, Shard shard) { return shard_file(output, shard, ".jsonl"); }
fs::path shard_report(const fs::path& output, Shard shard) { return shard_file(output, shard, ".json"); }

}  // namespace dstylize
