// Preloaded into dstylize: one call that changes files, one that reads them, or one allocation, fails or is the last.
// By the environment:
//   FAULT_AT=N         the Nth such call within main(), from 1; 0 for none
//   FAULT=28           its errno; 0 ends the process by SIGKILL instead, in the middle of a write
//   FAULT_CALLS=files  or `reads` or `memory`: what is counted
//   FAULT_LOG=FILE     gets a line for every call that is counted
// Only the program named dstylize is touched, not the codec that it starts.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

enum class Calls { none, files, reads, memory };

Calls counted = Calls::none;
long fault_at = 0;
int fault = 0, log_file = -1;
std::atomic<long> calls{0};

/// The C library's own function of that name.
template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

void begin() {
    const char* const what = std::getenv("FAULT_CALLS");
    if (!what || std::strcmp(program_invocation_short_name, "dstylize") != 0) return;
    if (const char* at = std::getenv("FAULT_AT")) fault_at = std::atol(at);
    if (const char* number = std::getenv("FAULT")) fault = std::atoi(number);
    if (const char* path = std::getenv("FAULT_LOG"))
        log_file = int(syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600));
    const auto is = [what](const char* kind) { return std::strcmp(what, kind) == 0; };
    counted = is("memory") ? Calls::memory : is("reads") ? Calls::reads : Calls::files;
}

/// Counts a call, and says whether it is the one that goes wrong. `errno` is then set.
bool goes_wrong(Calls kind, const char* name) {
    if (counted != kind) return false;
    const long number = ++calls;
    if (log_file >= 0) {
        char line[64];
        const int length = std::snprintf(line, sizeof line, "%ld %s\n", number, name);
        syscall(SYS_write, log_file, line, std::size_t(length));
    }
    if (number != fault_at) return false;
    errno = fault;
    return true;
}

/// The same for calls that have nothing to do by halves.
bool fails(Calls kind, const char* name) {
    if (!goes_wrong(kind, name)) return false;
    if (fault == 0) raise(SIGKILL);
    return true;
}

/// Memory and the standard streams are no files that are kept.
bool is_kept(int file) { return file > STDERR_FILENO && fcntl(file, F_GET_SEALS) < 0; }

/// Half of it is written, and then it fails or the process ends.
bool write_fails(int file, const void* bytes, std::size_t size) {
    if (!is_kept(file) || !goes_wrong(Calls::files, "write")) return false;
    struct stat status {};
    if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) syscall(SYS_write, file, bytes, size / 2);
    if (fault == 0) raise(SIGKILL);
    errno = fault;
    return true;
}

/// Of a file on a disk; those of the system say that they are empty.
bool read_fails(int file) {
    struct stat status {};
    if (counted != Calls::reads || fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || status.st_size == 0)
        return false;
    return is_kept(file) && fails(Calls::reads, "read");
}

int (*own_main)(int, char**, char**) = nullptr;

int main_with_faults(int count, char** words, char** environment) {
    begin();
    const int code = own_main(count, words, environment);
    counted = Calls::none;
    return code;
}

}  // namespace

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int count, char** words, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
    own_main = main;
    return next<decltype(__libc_start_main)>("__libc_start_main")(main_with_faults, count, words, init, fini, rtld_fini,
                                                                  stack_end);
}

ssize_t write(int file, const void* bytes, size_t size) {
    return write_fails(file, bytes, size) ? -1 : syscall(SYS_write, file, bytes, size);
}
ssize_t writev(int file, const iovec* parts, int count) {
    if (count > 0 && write_fails(file, parts[0].iov_base, parts[0].iov_len)) return -1;
    return syscall(SYS_writev, file, parts, count);
}

ssize_t read(int file, void* bytes, size_t size) {
    return read_fails(file) ? -1 : syscall(SYS_read, file, bytes, size);
}

int fsync(int file) { return fails(Calls::files, "fsync") ? -1 : int(syscall(SYS_fsync, file)); }

int rename(const char* from, const char* to) noexcept {
    return fails(Calls::files, "rename") ? -1 : next<decltype(rename)>("rename")(from, to);
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) noexcept {
    if (fails(Calls::files, "linkat")) return -1;
    return next<decltype(linkat)>("linkat")(from_folder, from, to_folder, to, flags);
}

int mkdir(const char* path, mode_t mode) noexcept {
    return fails(Calls::files, "mkdir") ? -1 : next<decltype(mkdir)>("mkdir")(path, mode);
}

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = flags & (O_CREAT | (O_TMPFILE & ~O_DIRECTORY)) ? va_arg(more, mode_t) : 0;
    va_end(more);
    if ((flags & (O_WRONLY | O_RDWR)) && std::strcmp(path, "/dev/null") != 0 && fails(Calls::files, "open")) return -1;
    return int(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

std::FILE* fopen(const char* path, const char* mode) {
    if (std::strpbrk(mode, "wa+") && fails(Calls::files, "fopen")) return nullptr;
    return next<decltype(fopen)>("fopen")(path, mode);
}

void* malloc(size_t size) noexcept {
    static const auto real = next<decltype(malloc)>("malloc");
    return fails(Calls::memory, "malloc") ? nullptr : real(size);
}
void* calloc(size_t count, size_t size) noexcept {
    static const auto real = next<decltype(calloc)>("calloc");
    return fails(Calls::memory, "calloc") ? nullptr : real(count, size);
}
void* realloc(void* at, size_t size) noexcept {
    static const auto real = next<decltype(realloc)>("realloc");
    return fails(Calls::memory, "realloc") ? nullptr : real(at, size);
}

}  // extern "C"

/// What others find under the large-file names.
extern "C" int open64(const char* path, int flags, ...) __attribute__((alias("open")));
extern "C" std::FILE* fopen64(const char* path, const char* mode) __attribute__((alias("fopen")));

/// The program's allocator has its own, which do not come by malloc().
void* operator new(std::size_t size) {
    if (void* const at = malloc(size)) return at;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
