#pragma once
#include <cairo.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/picture.h"

namespace dstylize::support {

/// A folder of its own for one test, removed at its end.
class Scratch {
  public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "dstylize-XXXXXX").string();
        folder_ = mkdtemp(name.data());
    }
    ~Scratch() { std::filesystem::remove_all(folder_); }
    Scratch(const Scratch&) = delete;
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }

  private:
    std::filesystem::path folder_;
};

struct Outcome {
    int status = -1;
    std::string output;  ///< standard output and error
};

inline Outcome outcome_of(const std::string& command) {
    Outcome result;
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) return result;
    std::array<char, 4096> buffer;
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
        result.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
}

/// A PNG as straight-alpha pixels; empty, and a failure, when it cannot be read.
inline Picture read_png(const std::string& path) {
    cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
    const int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
    EXPECT_GT(width * height, 0) << path << ": " << cairo_status_to_string(cairo_surface_status(surface));
    Picture picture({width, height});
    const bool alpha = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_ARGB32;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint32_t v;
            std::memcpy(&v, cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x,
                        4);
            const std::uint32_t a = alpha ? v >> 24 : 255;
            const auto straight = [&](int shift) {
                return std::uint8_t(a == 0 ? 0 : std::min(255u, ((v >> shift & 255u) * 255u + a / 2) / a));
            };
            picture(x, y) = {straight(16), straight(8), straight(0), std::uint8_t(a)};
        }
    cairo_surface_destroy(surface);
    return picture;
}

/// Straight-alpha pixels as a PNG file.
inline std::vector<std::byte> png_file(const Picture& picture) {
    cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, picture.extent().x, picture.extent().y);
    for (int y = 0; y < picture.extent().y; ++y)
        for (int x = 0; x < picture.extent().x; ++x) {
            const Rgba8 p = picture(x, y);
            const auto premultiplied = [&](std::uint8_t c) { return std::uint32_t((c * p.a + 127) / 255); };
            const std::uint32_t v =
                std::uint32_t(p.a) << 24 | premultiplied(p.r) << 16 | premultiplied(p.g) << 8 | premultiplied(p.b);
            std::memcpy(cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x, &v,
                        4);
        }
    cairo_surface_mark_dirty(surface);
    std::vector<std::byte> file;
    const auto append = [](void* to, const unsigned char* bytes, unsigned count) {
        const auto* first = reinterpret_cast<const std::byte*>(bytes);
        auto& out = *static_cast<std::vector<std::byte>*>(to);
        out.insert(out.end(), first, first + count);
        return CAIRO_STATUS_SUCCESS;
    };
    EXPECT_EQ(cairo_surface_write_to_png_stream(surface, append, &file), CAIRO_STATUS_SUCCESS);
    cairo_surface_destroy(surface);
    return file;
}

/// How two pictures of one size differ, over the three colour channels.
struct Difference {
    double rms = 0, mean = 0, worst = 0;
};

inline Difference difference(const Picture& a, const Picture& b) {
    Difference d;
    EXPECT_EQ(a.extent(), b.extent());
    if (!(a.extent() == b.extent())) return {255, 255, 255};
    for (std::size_t i = 0; i < a.size(); ++i)
        for (const int off : {a[i].r - b[i].r, a[i].g - b[i].g, a[i].b - b[i].b}) {
            d.rms += double(off) * off;
            d.mean += off;
            d.worst = std::max(d.worst, std::abs(double(off)));
        }
    d.rms = std::sqrt(d.rms / (3.0 * double(a.size())));
    d.mean /= 3.0 * double(a.size());
    return d;
}

}  // namespace dstylize::support
