#include "pipeline/ledger.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/error.h"
#include "formats/files.h"
#include "pipeline/path_json.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string line(const std::string& result, const Ledger::Entry& entry) {
    return json{{"result", path_json<json>(result)},
                {"input", entry.input_xxh128},
                {"key", entry.key},
                {"bytes", entry.bytes}}
               .dump() +
           "\n";
}

}  // namespace

Ledger::Ledger(const fs::path& output_folder, std::optional<Shard> shard)
    : file_(output_folder / ".dstylize" / "ledger.jsonl") {
    if (shard) {
        read(file_, common_);
        file_ = shard_ledger(output_folder, *shard);
        read(file_, entries_);
        return;
    }
    read(file_, entries_);
    shards_ = output_folder / ".dstylize" / "shards";
    std::error_code ignored;
    for (fs::recursive_directory_iterator at(shards_, ignored), end; at != end; at.increment(ignored))
        if (at->path().extension() == ".jsonl") read(at->path(), entries_);
}

void Ledger::read(const fs::path& path, Entries& entries) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return;
    const std::vector<std::byte> bytes = read_file(path, std::numeric_limits<std::uint64_t>::max());
    std::string_view lines(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (; !lines.empty(); lines.remove_prefix(std::min(lines.find('\n'), lines.size() - 1) + 1)) {
        const json tree = json::parse(lines.substr(0, lines.find('\n')), nullptr, false);
        if (!tree.is_object()) continue;
        try {
            entries[path_from_json(tree.at("result"))] = {tree.at("input"), tree.at("key"), tree.at("bytes")};
        } catch (const json::exception&) {
            continue;
        }
    }
}

const Ledger::Entry* Ledger::find(const std::string& result) const {
    const std::scoped_lock lock(mutex_);
    for (const Entries* entries : {&entries_, &common_})
        if (const auto at = entries->find(result); at != entries->end()) return &at->second;
    return nullptr;
}

void Ledger::add(const std::string& result, const Entry& entry) {
    const std::scoped_lock lock(mutex_);
    entries_[result] = entry;
    std::ofstream file(file_, std::ios::app);
    file << line(result, entry) << std::flush;
    if (!file)
        throw Error(ErrorCode::cannot_write, file_.string(), "cannot be written", "make room, or check its folder");
}

void Ledger::compact() const {
    const std::scoped_lock lock(mutex_);
    std::string text;
    for (const auto& [result, entry] : entries_) text += line(result, entry);
    write_file_atomically(file_, std::as_bytes(std::span(text)));
}

void Ledger::take_over_shards() const {
    std::error_code error;
    if (shards_.empty() || !fs::exists(shards_, error)) return;
    compact();
    fs::remove_all(shards_, error);
    if (error)
        throw Error(ErrorCode::cannot_write, shards_.string(), "cannot be removed (" + error.message() + ")",
                    "check its permissions");
}

}  // namespace dstylize
