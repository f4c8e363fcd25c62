#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace perifrac {

/// What a file that is being written is called: this is added to its name.
inline constexpr std::string_view temporary_suffix = ".tmp";

/// Writes a file, its parts one after the other, so that at any moment, a crash included, `target`
/// is the old file or the whole new one: the content goes to a temporary name in the same folder,
/// is brought to the disk and then renamed. Throws OutputError; `target` is then as it was and the
/// temporary gone.
void write_atomically(const std::filesystem::path& target,
                      std::initializer_list<std::string_view> parts);
inline void write_atomically(const std::filesystem::path& target, std::string_view content) {
  write_atomically(target, {content});
}

/// The same but for the disk: after a crash of the machine `target` may be empty. For what is soon
/// written anew. Returns whether it was.
bool replace_at_once(const std::filesystem::path& target, std::string_view content);

}  // namespace perifrac
