#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dstylize {

/// One machine's share of a list: every `count`-th entry from the `index`-th on, which is 1 for the first.
struct Shard {
    int index = 1, count = 1;
    friend bool operator==(const Shard&, const Shard&) = default;
};

/// As `--shard` takes it: K/N. Throws Error(bad_usage).
Shard parsed_shard(const std::string& text);

/// Where the entries of a list of `total` are that belong to the shard.
std::vector<std::size_t> shard_entries(Shard shard, std::size_t total);

/// Where runs of `count` shards keep their ledgers and reports.
std::filesystem::path shard_folder(const std::filesystem::path& output, int count);
std::filesystem::path shard_ledger(const std::filesystem::path& output, Shard shard);
std::filesystem::path shard_report(const std::filesystem::path& output, Shard shard);

}  // namespace dstylize
