#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace dstylize {

/// A monotone priority queue: multi-level buckets (Denardo & Fox 1979; Ahuja et al. 1990 call the
/// binary case a radix heap). No entry may be pushed below the priority last taken. An entry waits at
/// the level of the highest byte in which it differs from that priority, and moves down a level when
/// its bucket comes to be the first: eight moves at most, one or two in practice.
class RadixQueue {
  public:
    struct Entry {
        std::uint64_t priority;
        std::uint32_t node;
    };

    void push(Entry e) {
        const std::uint64_t differs = e.priority ^ last_;
        const unsigned level = unsigned(std::bit_width(differs | 1) - 1) / kDigitBits;
        const unsigned digit = unsigned(e.priority >> level * kDigitBits) % kDigits;
        level_[level].bucket[digit].push_back(e);
        level_[level].occupied[digit / 64] |= std::uint64_t{1} << digit % 64;
        levels_in_use_ |= 1u << level;
    }

    /// Once it is empty, any priority may be pushed again.
    void restart() { last_ = 0; }

    /// Takes all entries of the least priority into `taken`, in no order; false when none is left.
    /// Entries for which `is_stale` holds may be dropped on the way.
    template <class IsStale>
    bool take_least(std::vector<Entry>& taken, IsStale is_stale) {
        taken.clear();
        while (levels_in_use_ != 0) {
            const unsigned level = unsigned(std::countr_zero(levels_in_use_));
            const unsigned digit = first_digit(level);
            std::vector<Entry>& bucket = level_[level].bucket[digit];
            forget(level, digit);
            const unsigned shift = level * kDigitBits;
            const std::uint64_t higher_digits =
                shift + kDigitBits < 64 ? last_ >> (shift + kDigitBits) << (shift + kDigitBits) : 0;
            last_ = higher_digits | std::uint64_t{digit} << shift;
            if (level == 0) {
                taken.swap(bucket);
                return true;
            }
            for (const Entry& e : bucket)
                if (!is_stale(e)) push(e);
            bucket.clear();
        }
        return false;
    }

  private:
    static constexpr unsigned kDigitBits = 8, kDigits = 1u << kDigitBits, kLevels = 64 / kDigitBits;
    struct Level {
        std::array<std::vector<Entry>, kDigits> bucket;
        std::array<std::uint64_t, kDigits / 64> occupied{};
    };

    unsigned first_digit(unsigned level) const {
        unsigned word = 0;
        while (level_[level].occupied[word] == 0) ++word;
        return word * 64 + unsigned(std::countr_zero(level_[level].occupied[word]));
    }
    void forget(unsigned level, unsigned digit) {
        auto& occupied = level_[level].occupied;
        occupied[digit / 64] &= ~(std::uint64_t{1} << digit % 64);
        std::uint64_t any = 0;
        for (const std::uint64_t word : occupied) any |= word;
        if (any == 0) levels_in_use_ &= ~(1u << level);
    }

    std::array<Level, kLevels> level_;
    std::uint32_t levels_in_use_ = 0;
    std::uint64_t last_ = 0;
};

}  // namespace dstylize
