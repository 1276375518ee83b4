#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace dstylize {

/// What a folder run has made: OUT/.dstylize/ledger.jsonl, a line for every result. Lines are appended as results are
/// written, so that a run that is stopped in any way goes on where it was; a line that is not whole counts as none.
/// `add` may be called from several threads.
class Ledger {
  public:
    /// A result is what became of an input's content by everything else that shapes it.
    struct Entry {
        std::string input_xxh128, key;
        std::uint64_t bytes = 0;  ///< of the result's file
        friend bool operator==(const Entry&, const Entry&) = default;
    };

    /// Reads what there is. Throws Error(cannot_read).
    explicit Ledger(const std::filesystem::path& output_folder);

    /// The entry of a result, by its path from the output folder; null if there is none.
    const Entry* find(const std::string& result) const;
    /// Throws Error(cannot_write).
    void add(const std::string& result, const Entry& entry);
    /// Writes the ledger anew, without lines that later ones have replaced. Throws Error(cannot_write).
    void compact() const;

  private:
    std::filesystem::path file_;
    std::map<std::string, Entry> entries_;
    mutable std::mutex mutex_;
};

}  // namespace dstylize
