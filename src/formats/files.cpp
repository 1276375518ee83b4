#include "formats/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <string>
#include <system_error>

#include "core/error.h"
#include "ipc/descriptor.h"

namespace dstylize {
namespace {

using ipc::Descriptor;

std::string text_of(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannot_read(const std::string& name, std::string problem, std::string remedy) {
    throw Error(ErrorCode::cannot_read, name, std::move(problem), std::move(remedy));
}

[[noreturn]] void cannot_write(const std::string& name, int error) {
    std::string remedy = "check the folder and its permissions";
    if (error == ENOSPC || error == EDQUOT) remedy = "make room on the disk or write elsewhere";
    if (error == ENOENT || error == ENOTDIR) remedy = "make the folder first";
    if (error == EISDIR) remedy = "give a file name";
    throw Error(ErrorCode::cannot_write, name, "cannot be written (" + text_of(error) + ")", remedy);
}

/// 0 or the errno of what failed.
int write_error(const Descriptor& file, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t n = ::write(file.number(), bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return n < 0 ? errno : EIO;
        bytes = bytes.subspan(std::size_t(n));
    }
    return 0;
}

/// Keeps SIGPIPE from ending the process while a pipe is written: the reader's going away is an error
/// like any other. Blocks it in this thread and swallows the one that our write raised.
class PipeSignalBlocked {
  public:
    PipeSignalBlocked() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    PipeSignalBlocked(const PipeSignalBlocked&) = delete;
    PipeSignalBlocked& operator=(const PipeSignalBlocked&) = delete;
    ~PipeSignalBlocked() {
        const timespec no_wait{};
        if (!was_pending_)
            while (sigtimedwait(&pipe_, nullptr, &no_wait) == -1 && errno == EINTR) continue;
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

  private:
    sigset_t pipe_, before_;
    bool was_pending_ = false;
};

void write_directly(const Descriptor& file, const std::string& name, std::span<const std::byte> bytes) {
    const PipeSignalBlocked no_signal;
    if (const int error = write_error(file, bytes)) cannot_write(name, error);
}

/// A new file in the target's folder. It has no name while it is written, so that even a kill leaves
/// nothing behind; where the file system cannot do that, it has a name that is removed on failure.
class NewFile {
  public:
    explicit NewFile(const std::filesystem::path& target) : target_(target) {
        const std::filesystem::path folder = target.parent_path().empty() ? "." : target.parent_path();
        file_ = Descriptor(::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
        if (!file_)
            with_free_name([&](const char* name) {
                file_ = Descriptor(::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
                return bool(file_);
            });
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;
    ~NewFile() {
        if (!name_.empty()) ::unlink(name_.c_str());
    }

    /// 0 or the errno of the first step that failed: EEXIST when there is a target, which stays as it is.
    int create(std::span<const std::byte> bytes) {
        if (const int error = fill(bytes, 0)) return error;
        const bool linked = name_.empty() ? link_to(target_.c_str()) : ::link(name_.c_str(), target_.c_str()) == 0;
        return linked ? 0 : errno;
    }

    /// 0 or the errno of the first step that failed. `mode` 0 is that of any new file.
    int put_in_place(std::span<const std::byte> bytes, mode_t mode) {
        if (const int error = fill(bytes, mode)) return error;
        if (name_.empty()) {
            if (link_to(target_.c_str())) return 0;
            if (errno != EEXIST) return errno;
            with_free_name([&](const char* name) { return link_to(name); });
            if (name_.empty()) return error_;
        }
        if (::rename(name_.c_str(), target_.c_str()) != 0) return errno;
        name_.clear();
        return 0;
    }

  private:
    int fill(std::span<const std::byte> bytes, mode_t mode) {
        if (!file_) return error_;
        if (const int error = write_error(file_, bytes)) return error;
        if (mode != 0 && ::fchmod(file_.number(), mode) != 0) return errno;
        return ::fsync(file_.number()) == 0 ? 0 : errno;
    }

    bool link_to(const char* name) const {
        const std::string open_file = "/proc/self/fd/" + std::to_string(file_.number());
        return ::linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    }

    /// Calls `create` with names beside the target until it made one that did not exist: name_, or error_.
    template <class Create>
    void with_free_name(Create create) {
        // Long names are cut so that the suffix fits into the 255 bytes of a file name.
        const std::string stem = target_.filename().string().substr(0, 200);
        for (int attempt = 0; attempt < 1000; ++attempt) {
            const std::string file_name = fmt::format(".{}.{}-{}.tmp", stem, ::getpid(), attempt);
            const std::string name = (target_.parent_path() / file_name).string();
            if (create(name.c_str())) {
                name_ = name;
                return;
            }
            error_ = errno;
            if (error_ != EEXIST) return;
        }
    }

    std::filesystem::path target_;
    Descriptor file_;
    std::string name_;
    int error_ = 0;
};

std::filesystem::path folder_of(const std::filesystem::path& target) {
    return target.has_parent_path() ? target.parent_path() : ".";
}

/// A file is in place; its name's survival of a power cut hangs on this. It takes no memory, so that what is in place
/// is not called a failure.
void sync_folder(const std::filesystem::path& folder, const std::string& name) {
    const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory && ::fsync(directory.number()) != 0 && errno != EINVAL) cannot_write(name, errno);
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    const bool standard_input = path == "-";
    const std::string name = standard_input ? "standard input" : path.string();
    const Descriptor file(standard_input ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file)
        cannot_read(name, errno == ENOENT ? "no such file" : "cannot be read (" + text_of(errno) + ")",
                    errno == ENOENT ? "check its name" : "check its permissions");
    struct stat status {};
    if (::fstat(file.number(), &status) == 0 && S_ISDIR(status.st_mode))
        cannot_read(name, "is a folder", "give a file");

    const auto too_long = [&] {
        cannot_read(name, "is longer than " + std::to_string(max_bytes >> 20) + " MB", "raise --max-memory");
    };
    std::size_t expected = 1 << 16;
    if (S_ISREG(status.st_mode)) {
        if (std::uint64_t(status.st_size) > max_bytes) too_long();
        expected = std::max(expected, std::size_t(status.st_size) + 1);  // one more: its end is then seen
    }
    std::vector<std::byte> bytes(expected);
    std::size_t size = 0;
    while (true) {
        if (size == bytes.size()) bytes.resize(2 * size);
        const ssize_t n = ::read(file.number(), bytes.data() + size, bytes.size() - size);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) cannot_read(name, "cannot be read (" + text_of(errno) + ")", "check the disk and its permissions");
        if (n == 0) break;
        size += std::size_t(n);
        if (size > max_bytes) too_long();
    }
    bytes.resize(size);
    return bytes;
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    if (path == "-") return write_directly(Descriptor(::dup(STDOUT_FILENO)), "standard output", bytes);
    const std::string name = path.string();
    struct stat status {};
    const bool exists = ::stat(path.c_str(), &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) cannot_write(name, EISDIR);
    if (exists && !S_ISREG(status.st_mode)) {
        const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (!file) cannot_write(name, errno);
        return write_directly(file, name, bytes);
    }
    if (exists && ::access(path.c_str(), W_OK) != 0) cannot_write(name, errno);

    std::error_code ignored;
    std::filesystem::path target = exists ? std::filesystem::canonical(path, ignored) : path;
    if (target.empty()) target = path;
    const std::filesystem::path folder = folder_of(target);
    {
        NewFile file(target);
        if (const int error = file.put_in_place(bytes, exists ? status.st_mode & 07777 : 0)) cannot_write(name, error);
    }
    sync_folder(folder, name);
}

bool create_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const std::filesystem::path folder = folder_of(path);
    const std::string name = path.string();
    {
        NewFile file(path);
        const int error = file.create(bytes);
        if (error == EEXIST) return false;
        if (error) cannot_write(name, error);
    }
    sync_folder(folder, name);
    return true;
}

}  // namespace dstylize
