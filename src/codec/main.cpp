// The program dstylize-codec: loads the module that does its work (module.cpp) and runs it.
//
// OpenImageIO needs some 250 libraries on Debian. When a program is linked with them, the dynamic linker looks
// for each of their 150,000 symbols in one library after the other. A library that is opened by itself is
// searched first, with those that it needs; so the ones with most symbols are opened before the module, which
// nearly halves the time to load. Where one is missing nothing is lost but that time.
#include <dlfcn.h>
#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>

#include "codec/module.h"

int main(int argument_count, char** arguments) {
    std::uint64_t max_memory_bytes = 0;
    const std::string_view limit = argument_count == 2 ? arguments[1] : "";
    if (std::from_chars(limit.data(), limit.data() + limit.size(), max_memory_bytes).ec != std::errc()) {
        std::fputs("dstylize-codec: is started by dstylize to decode and encode pictures\n", stderr);
        return 2;
    }
    close_range(4, ~0u, 0);  // what the caller left open is no business of hostile files; 3 is the channel
    for (const char* library : std::initializer_list<const char*>{DSTYLIZE_OPENED_FIRST})
        dlopen(library, RTLD_LAZY | RTLD_LOCAL);
    std::error_code ignored;  // then the module is not found
    const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    const std::string beside = program.parent_path() / DSTYLIZE_CODEC_MODULE;
    void* const module = dlopen(beside.c_str(), RTLD_LAZY | RTLD_LOCAL);
    void* const entry = module ? dlsym(module, "dstylize_codec") : nullptr;
    if (!entry) {
        std::fprintf(stderr, "dstylize-codec: %s; install dstylize again\n", dlerror());
        return 1;
    }
    return reinterpret_cast<decltype(&dstylize_codec)>(entry)(max_memory_bytes);
}
