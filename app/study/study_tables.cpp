#include "app/study/study_tables.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/study/sentences.hpp"

namespace perifrac {

namespace {

using Row = std::vector<std::string>;

std::string label_of(const Study& study, const StudyPoint& point, std::size_t axis) {
  const auto& choice = point.variant->choice;
  return choice.empty() ? "" : study.axes[axis].values[choice[axis]].label;
}

std::string number(double value) { return fmt::format("{}", value); }

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const Row& row) {
  Row cells;
  for (const std::string& text : row) cells.push_back(csv_cell(text));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

/// `pore_flow wall_time [s]` and the like of one run, by name.
std::vector<std::pair<std::string, std::string>> work_of(const StudyPoint& point) {
  std::vector<std::pair<std::string, std::string>> work;
  if (!point.run.is_object()) return work;
  const nlohmann::json counts = point.run.value("counts", nlohmann::json::object());
  for (const auto& [name, count] : counts.items()) {
    work.emplace_back(name, count.dump());
  }
  for (const auto& module : point.run.value("modules", nlohmann::json::array())) {
    const std::string name = module["name"];
    work.emplace_back(name + " wall_time [s]", number(module["wall_time"]));
    work.emplace_back(name + " cpu_time [s]", number(module["cpu_time"]));
    work.emplace_back(name + " advances", module["advances"].dump());
    for (const auto& [statistic, count] : module["statistics"].items()) {
      work.emplace_back(name + " " + statistic, number(count));
    }
  }
  return work;
}

/// Names of all work of all variants, in the order of their coming.
Row work_names(const StudyResults& results) {
  Row names;
  for (const StudyPoint& point : results.points) {
    for (const auto& [name, value] : work_of(point)) {
      if (std::ranges::count(names, name) == 0) names.push_back(name);
    }
  }
  return names;
}

Row csv_header(const Study& study, const Row& work) {
  Row header = {"variant"};
  for (const StudyAxis& axis : study.axes) header.push_back(axis.name);
  for (const char* name :
       {"status", "error", "cost [s]", "cost least [s]", "cost most [s]", "wall_time [s]",
        "cpu_time [s]", "output_time [s]", "peak_memory [B]", "threads", "runs"}) {
    header.push_back(name);
  }
  header.insert(header.end(), work.begin(), work.end());
  header.push_back("message");
  return header;
}

Row csv_row(const Study& study, const StudyPoint& point, const Row& work) {
  Row row = {point.variant->name};
  for (std::size_t a = 0; a < study.axes.size(); ++a) row.push_back(label_of(study, point, a));
  row.push_back(word(point.record->status));
  row.push_back(point.is_ranked() ? number(*point.error.error) : "");
  for (const double value :
       {point.cost.median, point.cost.least, point.cost.most, point.wall.median, point.cpu_time,
        point.output_time, point.peak_memory}) {
    row.push_back(point.record->runs.empty() ? "" : number(value));
  }
  row.push_back(std::to_string(point.variant->threads));
  row.push_back(std::to_string(point.record->runs.size()));
  const auto done = work_of(point);
  for (const std::string& name : work) {
    const auto entry = std::ranges::find(done, name, &std::pair<std::string, std::string>::first);
    row.push_back(entry == done.end() ? "" : entry->second);
  }
  row.push_back(point.record->message);
  return row;
}

/// What papers show: axes first.
Row paper_header(const Study& study) {
  Row row;
  for (const StudyAxis& axis : study.axes) row.push_back(axis.name);
  for (const char* name :
       {"error", study.cpu_cost ? "CPU time" : "wall time", "times the cheapest", "memory"})
    row.push_back(name);
  return row;
}

/// An error or, in its place, how the variant ended; `least` is the cost of the
/// cheapest for the same problem.
Row paper_row(const Study& study, const StudyPoint& point, double least) {
  Row row;
  for (std::size_t a = 0; a < study.axes.size(); ++a) row.push_back(label_of(study, point, a));
  const bool done = point.record->status == VariantStatus::done;
  row.push_back(point.is_ranked() ? error_text(*point.error.error)
                                  : (done ? "none" : word(point.record->status)));
  const bool ran = !point.record->runs.empty();
  row.push_back(ran ? time_text(point.cost.median) : "");
  row.push_back(point.is_ranked() && least > 0.0 ? fmt::format("{:.3g}", point.cost.median / least)
                                                 : "");
  row.push_back(ran ? fmt::format("{:.0f} MB", point.peak_memory / 1e6) : "");
  return row;
}

/// Of the cheapest that solves the same problem; 0 where none does.
double least_cost(const StudyResults& results, const StudyPoint& point) {
  for (const Ranking& ranking : results.rankings) {
    const auto is_it = [&](std::size_t i) { return &results.points[i] == &point; };
    if (!ranking.front.empty() && std::ranges::any_of(ranking.ranked, is_it)) {
      return results.points[ranking.front.front()].cost.median;
    }
  }
  return 0.0;
}

std::vector<Row> paper_rows(const Study& study, const StudyResults& results) {
  std::vector<Row> rows;
  for (const StudyPoint& point : results.points) {
    if (point.variant->choice.empty()) continue;
    rows.push_back(paper_row(study, point, least_cost(results, point)));
  }
  return rows;
}

/// Signs that mean something to LaTeX.
std::string latex(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("_%&#${}").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c == '^' ? std::string("\\^{}") : std::string(1, c);
  }
  return escaped;
}

std::string markdown(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

Row each(const Row& row, std::string (*escape)(const std::string&)) {
  Row result;
  for (const std::string& text : row) result.push_back(escape(text));
  return result;
}

}  // namespace

std::string csv_table(const Study& study, const StudyResults& results) {
  const Row work = work_names(results);
  std::string text = csv_line(csv_header(study, work));
  for (const StudyPoint& point : results.points) text += csv_line(csv_row(study, point, work));
  return text;
}

std::string markdown_table(const Study& study, const StudyResults& results) {
  const Row header = paper_header(study);
  std::string text = fmt::format("| {} |\n|", fmt::join(each(header, markdown), " | "));
  for (std::size_t i = 0; i < header.size(); ++i) text += "---|";
  text += '\n';
  for (const Row& row : paper_rows(study, results)) {
    text += fmt::format("| {} |\n", fmt::join(each(row, markdown), " | "));
  }
  return text;
}

std::string latex_table(const Study& study, const StudyResults& results) {
  const Row header = paper_header(study);
  const std::string columns =
      std::string(study.axes.size(), 'l') + std::string(header.size() - study.axes.size(), 'r');
  std::string text = fmt::format("\\begin{{tabular}}{{{}}}\n\\hline\n{} \\\\\n\\hline\n", columns,
                                 fmt::join(each(header, latex), " & "));
  for (const Row& row : paper_rows(study, results)) {
    text += fmt::format("{} \\\\\n", fmt::join(each(row, latex), " & "));
  }
  return text + "\\hline\n\\end{tabular}\n";
}

}  // namespace perifrac
