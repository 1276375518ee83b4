// Damage as disks, transfers and attackers do it. Every choice comes from counter-based noise, so that a file of a
// campaign that went wrong can be made again from its number.
#include <algorithm>
#include <array>

#include "core/noise.h"
#include "corpus/sound.h"

namespace dstylize::test {
namespace {

/// Choices that depend on the file's number alone.
class Choices {
  public:
    explicit Choices(std::uint64_t number) : noise_(number, Purpose::white_noise) {}
    std::size_t below(std::size_t limit) {
        return std::size_t(noise_.bits(++drawn_) % std::max<std::size_t>(limit, 1));
    }
    template <std::size_t N>
    std::uint64_t of(const std::array<std::uint64_t, N>& values) {
        return values[below(N)];
    }

  private:
    Noise noise_;
    std::uint64_t drawn_ = 0;
};

using Damage = void (*)(FileBytes&, Choices&);

void cut(FileBytes& file, Choices& choice) { file.resize(choice.below(file.size())); }

void cut_a_little(FileBytes& file, Choices& choice) { file.resize(file.size() - 1 - choice.below(file.size() / 20)); }

void turn_bits(FileBytes& file, Choices& choice) {
    for (std::size_t times = 1 + choice.below(8); times > 0; --times)
        file[choice.below(file.size())] ^= std::byte(1u << choice.below(8));
}

/// Where formats keep their sizes and offsets.
void turn_bits_of_the_head(FileBytes& file, Choices& choice) {
    for (std::size_t times = 1 + choice.below(4); times > 0; --times)
        file[choice.below(std::min<std::size_t>(file.size(), 64))] ^= std::byte(1u << choice.below(8));
}

void lie(FileBytes& file, Choices& choice) {
    const std::uint64_t number = choice.of(
        std::array<std::uint64_t, 9>{0, 1, 0xff, 0xffff, 0x10000, 0x7fffffff, 0x80000000, 0xfffffff0, 0xffffffff});
    const std::size_t size = choice.below(2) ? 4 : 2, at = choice.below(file.size());
    const bool big = choice.below(2);
    for (std::size_t k = 0; k < size && at + k < file.size(); ++k)
        file[at + k] = std::byte(number >> 8 * (big ? size - 1 - k : k));
}

void blank(FileBytes& file, Choices& choice) {
    const std::size_t at = choice.below(file.size()), length = 1 + choice.below(file.size() / 4);
    const auto value = choice.below(2) ? std::byte{0} : std::byte{0xff};
    std::fill_n(file.begin() + std::ptrdiff_t(at), std::min(length, file.size() - at), value);
}

void leave_out(FileBytes& file, Choices& choice) {
    const std::size_t at = choice.below(file.size()), length = 1 + choice.below(64);
    const auto begin = file.begin() + std::ptrdiff_t(at);
    file.erase(begin, begin + std::ptrdiff_t(std::min(length, file.size() - at)));
}

void put_in(FileBytes& file, Choices& choice) {
    FileBytes more(1 + choice.below(200));
    for (std::byte& b : more) b = std::byte(choice.below(256));
    file.insert(file.begin() + std::ptrdiff_t(choice.below(file.size())), more.begin(), more.end());
}

void repeat(FileBytes& file, Choices& choice) {
    const std::size_t at = choice.below(file.size()), length = std::min(1 + choice.below(300), file.size() - at);
    const FileBytes part(file.begin() + std::ptrdiff_t(at), file.begin() + std::ptrdiff_t(at + length));
    for (std::size_t times = 1 + choice.below(20); times > 0; --times)
        file.insert(file.begin() + std::ptrdiff_t(at), part.begin(), part.end());
}

constexpr Damage kDamages[] = {cut,       cut_a_little, turn_bits, turn_bits_of_the_head, lie, lie, blank,
                               leave_out, put_in,       repeat};

}  // namespace

CorpusFile damaged_picture(const std::vector<CorpusFile>& sound, std::uint64_t number) {
    Choices choice(number);
    CorpusFile file = sound[number % sound.size()];
    for (std::size_t times = 1 + choice.below(2); times > 0 && !file.bytes.empty(); --times)
        kDamages[choice.below(std::size(kDamages))](file.bytes, choice);
    file.extent = {};
    file.name = std::to_string(number) + "-" + file.name;
    return file;
}

}  // namespace dstylize::test
