/// What the readers know of a case file's keys, for the test that holds KEYS.md to them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace drillstrand {

struct KeyNote {
    std::set<std::string> types;      ///< "m", "number", "schedule, N", "text", "table" and others
    std::set<std::string> ranges;     ///< as in messages: "more than 0", "\"a\" or \"b\""
    std::set<std::string> standards;  ///< where the key is left out
    bool required = false;
};

/// While an object lives, the readers of its thread note every key that they know, and what they
/// ask of the ones they read. Entries of lists stand for all: string.component.0.length is noted
/// as string.component.length.
class KeyNotes {
  public:
    KeyNotes();
    KeyNotes(const KeyNotes&) = delete;
    KeyNotes& operator=(const KeyNotes&) = delete;
    ~KeyNotes();

    [[nodiscard]] const std::map<std::string, KeyNote>& notes() const { return notes_; }

    // What readers say; without an object nothing happens.
    static void known(std::string_view path);
    static void type(std::string_view path, std::string_view type, const std::string& range = "");
    static void standard(std::string_view path, const std::string& value);
    static void required(std::string_view path);

  private:
    KeyNote& of(std::string_view path);

    std::map<std::string, KeyNote> notes_;
};

}  // namespace drillstrand
