#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace dstylize {

/// One independent random stream per purpose, so that adding a stage never reshuffles another.
enum class Purpose : std::uint32_t {
    white_noise,
    smooth_noise,
    swirl,
    endpoints,
    leaves,
    paper,
    jitter,
    warp,
    ragged_outline,
    relief,
    bark,
    brush,
    foreground
};

/// Counter-based noise (Philox 4x32-10, Salmon et al. 2011): a value depends on (seed, purpose,
/// index) alone, never on the order of calls or on threads.
class Noise {
  public:
    constexpr Noise(std::uint64_t seed, Purpose purpose, std::uint32_t substream = 0)
        : stream_{{std::uint32_t(seed), std::uint32_t(seed >> 32)}, std::uint32_t(purpose), substream} {}

    /// 32 random bits for `index`.
    constexpr std::uint32_t bits(std::uint64_t index) const { return block(index)[0]; }
    /// Uniform in [0, 1), exact in a float's 24 bits.
    constexpr float unit(std::uint64_t index) const { return unit_of(bits(index)); }
    /// unit() of `first` and the indices after it, several at a time.
    void units(std::uint64_t first, std::span<float> out) const;
    /// 32 random bits as a number in [0, 1).
    static constexpr float unit_of(std::uint32_t random) { return float(random >> 8) * kUnit; }
    /// All four words of the block for `index`; the counter is (index low, index high, purpose, substream).
    constexpr std::array<std::uint32_t, 4> block(std::uint64_t index) const {
        std::array<std::uint32_t, 4> c{std::uint32_t(index), std::uint32_t(index >> 32), stream_.purpose,
                                       stream_.substream};
        std::array<std::uint32_t, 2> k = stream_.key;
        for (int round = 0; round < kRounds; ++round, k = next_key(k)) {
            const std::uint64_t p0 = std::uint64_t{kFactors[0]} * c[0], p1 = std::uint64_t{kFactors[1]} * c[2];
            c = {std::uint32_t(p1 >> 32) ^ c[1] ^ k[0], std::uint32_t(p1), std::uint32_t(p0 >> 32) ^ c[3] ^ k[1],
                 std::uint32_t(p0)};
        }
        return c;
    }

    // What the generator consists of: units() needs it for each instruction set.
    struct Stream {
        std::array<std::uint32_t, 2> key;
        std::uint32_t purpose, substream;
    };
    static constexpr int kRounds = 10;
    static constexpr std::uint32_t kFactors[2] = {0xD2511F53, 0xCD9E8D57};
    static constexpr float kUnit = 0x1p-24f;
    static constexpr std::array<std::uint32_t, 2> next_key(std::array<std::uint32_t, 2> k) {
        return {k[0] + 0x9E3779B9u, k[1] + 0xBB67AE85u};
    }

  private:
    Stream stream_;
};

}  // namespace dstylize
