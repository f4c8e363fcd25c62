#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

namespace perifrac {

/// What is known of a file: `what` it is, and facts in the order in which they are shown.
struct FileFacts {
  std::string what;
  nlohmann::ordered_json facts;
};

/// Each looks at a file, and at its name, and answers nothing where it is of another kind. What is
/// of the kind and cannot be read throws InputError.
std::optional<FileFacts> checkpoint_facts(const std::filesystem::path& file);
std::optional<FileFacts> frame_facts(const std::filesystem::path& file);
std::optional<FileFacts> frame_list_facts(const std::filesystem::path& file);
std::optional<FileFacts> history_facts(const std::filesystem::path& file);
std::optional<FileFacts> exported_facts(const std::filesystem::path& file);
std::optional<FileFacts> summary_facts(const std::filesystem::path& file);
std::optional<FileFacts> study_facts(const std::filesystem::path& file);
std::optional<FileFacts> drawing_facts(const std::filesystem::path& file);
std::optional<FileFacts> scene_facts(const std::filesystem::path& file);

/// The first bytes of a file; fewer where it is shorter.
std::string beginning(const std::filesystem::path& file, std::size_t count);

/// The document in a file of JSON; nothing where it is none.
std::optional<nlohmann::ordered_json> json_in(const std::filesystem::path& file);

}  // namespace perifrac
