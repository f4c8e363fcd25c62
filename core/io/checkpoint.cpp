#include "core/io/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/hdf5.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {
namespace {

// The seal is a text in front of the HDF5 file (its user block: HDF5 looks for its own beginning at
// 0, 512, 1024, ...). It is checked before HDF5 sees the file, which may crash on a damaged one.
constexpr std::size_t seal_size = 512;
/// Format 2: points of lattices have other numbers than in format 1.
constexpr std::string_view seal_title = "perifrac checkpoint, format 2\n";

constexpr std::size_t npos = std::string::npos;

std::string size_line(std::size_t size) { return fmt::format("{}{} bytes, ", seal_title, size); }

/// The seal that belongs to the rest of the file.
std::string make_seal(std::string_view content) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a, 64 bits
  for (const char byte : content) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  }
  std::string seal = size_line(content.size()) + fmt::format("FNV-1a {:016x}\n", hash);
  seal.resize(seal_size, '\0');
  return seal;
}

void check_seal(const std::filesystem::path& path) {
  InputFile file(path, "a checkpoint_*.h5 of a run");
  const std::string seal = file.read(seal_size);
  if (!seal.starts_with(seal_title)) {
    throw InputError(path.string() +
                     ": not a checkpoint that this version can read; expected a checkpoint_*.h5 "
                     "that perifrac wrote");
  }
  // The size that it should have is known before the rest is read.
  const bool is_whole =
      seal.starts_with(size_line(file.size() - seal.size())) && seal == make_seal(file.read(npos));
  if (!is_whole) {
    throw InputError(path.string() +
                     ": the checkpoint is damaged or cut short; its checksum must match; restart "
                     "from the other checkpoint_*.h5 of the run");
  }
}

void write_state(Hdf5Writer& file, const Checkpoint& checkpoint) {
  file.write<double>("time", std::array{checkpoint.time});
  file.write<std::int64_t>("step", std::array{checkpoint.step});
  file.write_text("scene", checkpoint.scene);
  file.write_text("version", checkpoint.version);
  file.create_group("state");
  for (const auto& field : checkpoint.state.fields()) {
    std::visit([&](const auto& array) { file.write("state/" + field.first, std::span(array)); },
               field.second);
  }
}

/// The step in the name of a checkpoint; nothing for any other name.
std::optional<std::int64_t> step_of(const std::filesystem::path& path) {
  constexpr std::string_view begin = "checkpoint_";
  constexpr std::string_view end = ".h5";
  const std::string name = path.filename();
  if (!name.starts_with(begin) || !name.ends_with(end) ||
      name.size() <= begin.size() + end.size()) {
    return {};
  }
  std::int64_t step = 0;
  const char* last = name.data() + name.size() - end.size();
  const auto [stop, error] = std::from_chars(name.data() + begin.size(), last, step);
  return stop == last && error == std::errc{} ? std::optional(step) : std::nullopt;
}

void remove_older(const std::filesystem::path& folder, std::int64_t step) {
  std::vector<std::filesystem::path> others;
  std::filesystem::path previous;
  std::int64_t previous_step = -1;
  std::error_code ignored;  // one file too many does no harm
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const auto other = step_of(entry.path());
    if (!other || other == step) {
      continue;
    }
    others.push_back(entry.path());
    if (const auto number = other.value(); number > previous_step && number < step) {
      previous_step = number;
      previous = entry.path();
    }
  }
  for (const auto& path : others) {
    if (path != previous) {
      std::filesystem::remove(path, ignored);
    }
  }
}

}  // namespace

std::filesystem::path write_checkpoint(const std::filesystem::path& output_folder,
                                       const Checkpoint& checkpoint) {
  const auto path = output_folder / fmt::format("checkpoint_{:06}.h5", checkpoint.step);
  Hdf5Writer file;
  write_state(file, checkpoint);
  const std::string_view content = file.bytes();
  write_atomically(path, {make_seal(content), content});
  remove_older(output_folder, checkpoint.step);
  return path;
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  check_seal(path);
  const Hdf5Reader file(path);
  Snapshot::Fields fields;
  for (const std::string& name : file.datasets("state")) {
    const std::string dataset = "state/" + name;
    if (file.holds_integers(dataset)) {
      fields[name] = file.read<std::int64_t>(dataset);
    } else {
      fields[name] = file.read<double>(dataset);
    }
  }
  return {.time = file.read<double>("time").at(0),
          .step = file.read<std::int64_t>("step").at(0),
          .scene = file.read_text("scene"),
          .version = file.read_text("version"),
          .state = Snapshot(std::move(fields))};
}

}  // namespace perifrac
