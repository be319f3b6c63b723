#include "drillstrand/new_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <new>
#include <string>
#include <system_error>
#include <utility>

#include "drillstrand/error.hpp"
#include "results/held_file.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_unwritten_bytes = std::size_t{1} << 16;

/// Names of files that have not taken their own yet: NAME.newPROCESS, with _2, _3... behind where
/// two machines share a folder and have processes of one number.
fs::path name_beside(const fs::path& target, int attempt) {
    fs::path path = target;
    path += fmt::format(".new{}", ::getpid());
    if (attempt > 1) path += fmt::format("_{}", attempt);
    return path;
}

bool is_beside(const fs::path& path, const fs::path& target) {
    const std::string name = path.filename().string();
    const std::string start = target.filename().string() + ".new";
    return name.size() > start.size() && name.starts_with(start) &&
           std::all_of(name.begin() + static_cast<std::ptrdiff_t>(start.size()), name.end(),
                       [](unsigned char c) { return std::isdigit(c) != 0 || c == '_'; });
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void remove_what_was_left(const fs::path& target) {
    std::error_code problem;
    for (fs::directory_iterator entry(folder_of(target), problem), end; !problem && entry != end;
         entry.increment(problem))
        if (is_beside(entry->path(), target)) remove_if_forsaken(entry->path());
}

[[noreturn]] void refuse_to_replace(const fs::path& shown_path) {
    throw ResultError(shown_path.string() + ": there is a file of that name already");
}

/// Throws where a file is there that this one may not replace. HDF5's own words are vague.
void require_free(const fs::path& target, const fs::path& shown_path, Existing existing) {
    std::error_code problem;
    const fs::file_status status = fs::status(target, problem);
    if (status.type() == fs::file_type::not_found) return;
    if (status.type() == fs::file_type::none) refuse_to_write(shown_path, problem.value());
    HeldFile::require_free(target, shown_path);
    if (existing == Existing::keep) refuse_to_replace(shown_path);
}

}  // namespace

fs::path followed(const fs::path& path) {
    std::error_code problem;
    fs::path target = fs::weakly_canonical(fs::absolute(path, problem), problem);
    if (problem) refuse_to_write(path, problem.value());
    // it stops at a link to a file that is not there yet
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, problem)); ++links) {
        if (links == 40) refuse_to_write(path, ELOOP);
        const fs::path next = fs::read_symlink(target, problem);
        if (problem) refuse_to_write(path, problem.value());
        target = fs::weakly_canonical(folder_of(target) / next, problem);
        if (problem) refuse_to_write(path, problem.value());
    }
    return target;
}

NewFile::NewFile(const fs::path& path, Existing existing)
    : shown_path_(path), target_(followed(path)), existing_(existing) {
    require_free(target_, shown_path_, existing_);
    remove_what_was_left(target_);
    for (int attempt = 1; !held_; ++attempt) {
        path_ = name_beside(target_, attempt);
        auto file = HeldFile::create(path_, shown_path_);
        if (!file) continue;
        try {
            held_ = std::make_unique<HeldFile>(std::move(*file));
        } catch (const std::bad_alloc&) {
            ::unlink(path_.c_str());
            throw;
        }
    }
}

NewFile::NewFile(NewFile&&) noexcept = default;

NewFile::~NewFile() {
    if (!named_ && held_) ::unlink(path_.c_str());
}

void NewFile::write(std::string_view bytes) {
    unwritten_ += bytes;
    if (unwritten_.size() > most_unwritten_bytes) write_rest();
}

void NewFile::write_rest() {
    held_->write(unwritten_);
    unwritten_.clear();
}

void NewFile::take_name() {
    write_rest();
    // another drillstrand may have come first since the file was begun
    const HeldFolder folder(folder_of(target_));
    require_free(target_, shown_path_, existing_);
    if (existing_ == Existing::keep) {
        named_ =
            ::renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0;
        if (!named_ && errno == EEXIST) refuse_to_replace(shown_path_);
        // not every file system can
        if (!named_ && errno != EINVAL && errno != ENOSYS) refuse_to_write(shown_path_, errno);
    }
    if (!named_ && std::rename(path_.c_str(), target_.c_str()) != 0)
        refuse_to_write(shown_path_, errno);
    named_ = true;
}

std::unique_ptr<HeldFile> NewFile::release() {
    return std::move(held_);
}

}  // namespace drillstrand
