#include "core/io/history.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/file_descriptor.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {
namespace {

/// Quoted as CSV wants it where a probe's name holds a separator.
std::string cell(const HistoryColumn& column) {
  const std::string text =
      column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
  if (text.find_first_of(",\"\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted.append(c == '"' ? 2 : 1, c);
  }
  return quoted + '"';
}

std::string make_header(const std::vector<HistoryColumn>& columns) {
  std::string header = "time [s],step";
  for (const HistoryColumn& column : columns) {
    header += ',' + cell(column);
  }
  return header + '\n';
}

/// The step of a row `time,step,...`.
std::int64_t step_of(std::string_view row) {
  std::int64_t step = std::numeric_limits<std::int64_t>::max();  // a row without one is not kept
  if (const auto comma = row.find(','); comma != std::string_view::npos) {
    std::from_chars(row.data() + comma + 1, row.data() + row.size(), step);
  }
  return step;
}

/// The rows of an old table up to a step. A last row without an end was cut off in writing.
std::string rows_to_keep(const std::filesystem::path& file, const std::string& header,
                         std::int64_t restart_step) {
  const std::string table = InputFile(file, "the history of this run").read(std::string::npos);
  if (!table.starts_with(header)) {
    throw InputError(
        fmt::format("{}: has other columns than this run; expected {}; give another "
                    "output folder",
                    file.string(), header.substr(0, header.size() - 1)));
  }
  std::size_t kept = header.size();
  for (auto end = table.find('\n', kept); end != std::string::npos; end = table.find('\n', kept)) {
    if (step_of(std::string_view(table).substr(kept, end - kept)) > restart_step) {
      break;
    }
    kept = end + 1;
  }
  return table.substr(header.size(), kept - header.size());
}

}  // namespace

History::History(std::filesystem::path file, const std::vector<HistoryColumn>& columns,
                 std::optional<std::int64_t> restart_step)
    : file_(std::move(file)) {
  const std::string header = make_header(columns);
  const bool keep = restart_step && std::filesystem::exists(file_);
  const std::string table = header + (keep ? rows_to_keep(file_, header, *restart_step) : "");
  write_atomically(file_, table);
  size_ = table.size();
}

void History::append(double time, std::int64_t step, std::span<const double> values) {
  std::string row = fmt::format("{},{}", time, step);
  for (const double value : values) {
    row += fmt::format(",{}", value);
  }
  // Opened anew for each row: a folder that was removed meanwhile is noticed.
  const FileDescriptor file(file_, O_WRONLY | O_APPEND);
  row += '\n';
  if (!file.is_open() || !file.append(row)) {
    throw OutputError(file_.string(), std::strerror(errno));
  }
  size_ += row.size();
}

void History::check_kept() const {
  std::error_code error;
  if (std::filesystem::file_size(file_, error) == size_ && !error) return;
  throw OutputError(file_.string(), "somebody else has changed it while the run went on");
}

}  // namespace perifrac
