/// A library to be loaded before all others (LD_PRELOAD), which lets one call of the program fail,
/// or all from one on. DRILLSTRAND_FAIL says which:
///
///     write:17      the 17th call that changes a file: as on a full disk
///     memory:9+     the 9th allocation and all after it: no memory
///
/// A crash within HDF5's library, which does not look at all that it allocates, ends with exit code
/// 77: it is none of ours. Counted from the start of main(). DRILLSTRAND_COUNT names a file for the
/// number of calls that a run to its end makes.
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<bool> in_main = false;
std::atomic<long> calls = 0;
const char* kind = "";
long first = 0;
bool all_after = false;

using Main = int (*)(int, char**, char**);
Main program_main = nullptr;

bool fails(const char* of) {
    if (!in_main.load() || std::strcmp(kind, of) != 0) return false;
    const long call = ++calls;
    return call == first || (all_after && call > first);
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

template <class Result>
Result full_disk() {
    errno = ENOSPC;
    return static_cast<Result>(-1);
}

void* no_memory() {
    errno = ENOMEM;
    return nullptr;
}

void read_wish() {
    const char* wish = std::getenv("DRILLSTRAND_FAIL");
    if (wish == nullptr) return;
    kind = std::strncmp(wish, "memory", 6) == 0 ? "memory" : "write";
    const char* number = std::strchr(wish, ':');
    if (number == nullptr) return;
    char* end = nullptr;
    first = std::strtol(number + 1, &end, 10);
    all_after = *end == '+';
}

/// Ends the process where HDF5's library crashed, or a function of C that it called; lets it crash
/// where it is ours.
void name_who_crashed(int signal) {
    void* frames[32];
    const int count = ::backtrace(frames, 32);
    for (int k = 0; k < count; ++k) {
        Dl_info where{};
        if (::dladdr(frames[k], &where) == 0 || where.dli_fname == nullptr) continue;
        if (std::strstr(where.dli_fname, "libhdf5") != nullptr) ::_exit(77);
        if (std::strstr(where.dli_fname, "drillstrand") != nullptr &&
            std::strstr(where.dli_fname, "failing_calls") == nullptr)
            break;
    }
    ::signal(signal, SIG_DFL);
}

void watch_crashes() {
    void* frame = nullptr;
    ::backtrace(&frame, 1);  // loads what it needs
    for (const int crash : {SIGSEGV, SIGABRT})
        ::signal(crash, name_who_crashed);
}

int counted_main(int argc, char** argv, char** environment) {
    read_wish();
    watch_crashes();
    in_main = true;
    const int code = program_main(argc, argv, environment);
    in_main = false;
    if (const char* path = std::getenv("DRILLSTRAND_COUNT")) {
        FILE* file = std::fopen(path, "w");
        std::fprintf(file, "%ld\n", calls.load());
        std::fclose(file);
    }
    return code;
}

}  // namespace

extern "C" {

int __libc_start_main(Main entry, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*loader_fini)(), void* stack_end) {
    using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
    program_main = entry;
    return next<Start>("__libc_start_main")(counted_main, argc, argv, init, fini, loader_fini,
                                            stack_end);
}

void* malloc(std::size_t size) {
    return fails("memory") ? no_memory() : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
    return fails("memory") ? no_memory() : __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
    return fails("memory") ? no_memory() : __libc_realloc(old, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
    return fails("memory") ? no_memory() : __libc_memalign(alignment, size);
}

int posix_memalign(void** result, std::size_t alignment, std::size_t size) {
    if (fails("memory")) return ENOMEM;
    *result = __libc_memalign(alignment, size);
    return *result == nullptr ? ENOMEM : 0;
}

// what is said to a person is no file
ssize_t write(int file, const void* bytes, std::size_t count) {
    if (file > STDERR_FILENO && fails("write")) return full_disk<ssize_t>();
    return next<ssize_t (*)(int, const void*, std::size_t)>("write")(file, bytes, count);
}

ssize_t pwrite(int file, const void* bytes, std::size_t count, off_t place) {
    if (fails("write")) return full_disk<ssize_t>();
    return next<ssize_t (*)(int, const void*, std::size_t, off_t)>("pwrite")(file, bytes, count,
                                                                             place);
}

ssize_t pwrite64(int file, const void* bytes, std::size_t count, off64_t place) {
    if (fails("write")) return full_disk<ssize_t>();
    return next<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64")(file, bytes, count,
                                                                                 place);
}

int ftruncate(int file, off_t size) noexcept {
    if (fails("write")) return full_disk<int>();
    return next<int (*)(int, off_t)>("ftruncate")(file, size);
}

int ftruncate64(int file, off64_t size) noexcept {
    if (fails("write")) return full_disk<int>();
    return next<int (*)(int, off64_t)>("ftruncate64")(file, size);
}

int posix_fallocate(int file, off_t start, off_t size) {
    if (fails("write")) return ENOSPC;
    return next<int (*)(int, off_t, off_t)>("posix_fallocate")(file, start, size);
}

int fsync(int file) {
    if (fails("write")) return full_disk<int>();
    return next<int (*)(int)>("fsync")(file);
}

int rename(const char* from, const char* to) noexcept {
    if (fails("write")) return full_disk<int>();
    return next<int (*)(const char*, const char*)>("rename")(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
    if (fails("write")) return full_disk<int>();
    return next<int (*)(int, const char*, int, const char*, unsigned)>("renameat2")(
        from_folder, from, to_folder, to, flags);
}

}  // extern "C"
