#include "pipeline/ledger.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.h"
#include "formats/files.h"

namespace dstylize {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string line(const std::string& result, const Ledger::Entry& entry) {
    return json{{"result", result}, {"input", entry.input_xxh128}, {"key", entry.key}, {"bytes", entry.bytes}}.dump(
               -1, ' ', false, json::error_handler_t::replace) +
           "\n";
}

}  // namespace

Ledger::Ledger(const fs::path& output_folder) : file_(output_folder / ".dstylize" / "ledger.jsonl") {
    std::error_code ignored;
    if (!fs::exists(file_, ignored)) return;
    std::ifstream file(file_);
    if (!file) throw Error(ErrorCode::cannot_read, file_.string(), "cannot be read", "check its permissions");
    for (std::string text; std::getline(file, text);) {
        const json tree = json::parse(text, nullptr, false);
        if (!tree.is_object()) continue;
        try {
            entries_[tree.at("result")] = {tree.at("input"), tree.at("key"), tree.at("bytes")};
        } catch (const json::exception&) {
            continue;
        }
    }
}

const Ledger::Entry* Ledger::find(const std::string& result) const {
    const std::scoped_lock lock(mutex_);
    const auto at = entries_.find(result);
    return at == entries_.end() ? nullptr : &at->second;
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

}  // namespace dstylize
