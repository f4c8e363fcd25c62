// OpenBLAS takes a buffer of 128 MiB for every thread while the program is loaded, and where there
// is no room it tries for ever. So the program looks for the room first, before any library begins:
// a time at which only the system itself can be asked.
#include <algorithm>
#include <cstddef>
#include <sched.h>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

namespace {

constexpr std::size_t mebibyte = 1 << 20;
constexpr std::size_t room_for_a_thread = 128 * mebibyte;
constexpr std::size_t room_for_the_rest = 16 * mebibyte;

/// Threads of OpenMP: OMP_NUM_THREADS, else one for every processor.
std::size_t thread_count(char** environment) {
  constexpr std::string_view name = "OMP_NUM_THREADS=";
  constexpr std::size_t most = 1024;
  std::size_t threads = 0;
  for (; *environment != nullptr; ++environment) {
    std::string_view entry = *environment;
    if (!entry.starts_with(name)) continue;
    entry.remove_prefix(name.size());
    for (; !entry.empty() && entry[0] >= '0' && entry[0] <= '9'; entry.remove_prefix(1)) {
      threads = std::min(most, 10 * threads + static_cast<std::size_t>(entry[0] - '0'));
    }
  }
  cpu_set_t processors;
  CPU_ZERO(&processors);
  if (::sched_getaffinity(0, sizeof processors, &processors) != 0)
    return std::max<std::size_t>(threads, 1);
  const auto here = static_cast<std::size_t>(CPU_COUNT(&processors));
  return threads == 0 ? here : std::min(threads, here);
}

void look_for_room(int, char**, char** environment) {
  const std::size_t room = thread_count(environment) * room_for_a_thread + room_for_the_rest;
  void* const place =
      ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place != MAP_FAILED) {
    ::munmap(place, room);
    return;
  }
  constexpr std::string_view words =
      "perifrac: out of memory before it began: it takes 128 MB of address space for every thread; "
      "allow more (ulimit -v), or fewer threads (OMP_NUM_THREADS)\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, words.data(), words.size());
  ::_exit(1);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const first_of_all)(int, char**,
                                                                         char**) = look_for_room;

}  // namespace
