#include "core/profile/profile.hpp"

#include <ctime>
#include <fstream>
#include <malloc.h>
#include <stdexcept>
#include <unistd.h>

namespace perifrac {

namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// What was asked for and not given back, of all threads [bytes].
std::int64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<std::int64_t>(info.uordblks + info.hblkhd);
}

}  // namespace

thread_local Profile* Profile::active_ = nullptr;

std::int64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::int64_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

Profile::Profile() : resident_at_start_(resident_bytes()) {
  if (active_ != nullptr) throw std::logic_error("two profiles of one thread");
  parts_.push_back({});
  open_.push_back({0, true});
  last_ = Clock::now();
  last_cpu_ = processor_seconds();
  last_heap_ = heap_bytes();
  active_ = this;
}

Profile::~Profile() { active_ = nullptr; }

void Profile::enter(std::string_view name, bool weighs) {
  book_time();
  if (weighs) book_bytes();
  const int part = part_named(name, open_.back().part);
  ++parts_[part].calls;
  open_.push_back({part, weighs});
}

void Profile::leave() {
  book_time();
  if (open_.back().weighs) book_bytes();
  open_.pop_back();
}

const std::vector<Profile::Part>& Profile::parts() {
  book_time();
  book_bytes();
  return parts_;
}

int Profile::part_named(std::string_view name, int within) {
  for (std::size_t k = 1; k < parts_.size(); ++k) {
    if (parts_[k].within == within && parts_[k].name == name) return static_cast<int>(k);
  }
  parts_.push_back({.name = std::string(name), .within = within});
  return static_cast<int>(parts_.size()) - 1;
}

void Profile::book_time() {
  const Clock::time_point now = Clock::now();
  const double cpu = processor_seconds();
  Part& part = parts_[open_.back().part];
  part.seconds += std::chrono::duration<double>(now - last_).count();
  part.cpu_seconds += cpu - last_cpu_;
  last_ = now;
  last_cpu_ = cpu;
}

/// The innermost part that weighs also has what grew in those within it that do not.
void Profile::book_bytes() {
  const std::int64_t heap = heap_bytes();
  std::size_t k = open_.size() - 1;
  while (!open_[k].weighs) --k;
  parts_[open_[k].part].bytes += heap - last_heap_;
  last_heap_ = heap;
}

}  // namespace perifrac
