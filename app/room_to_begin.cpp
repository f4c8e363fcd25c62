// OpenBLAS takes a buffer of 128 MiB for every thread, two at the least, most while the program is
// loaded and the rest when it is first used; where there is no room it tries for ever. So the
// program looks for the room first, before any library begins, a time at which only the system
// itself can be asked, and has OpenBLAS take all of it before anything else can.
// OpenMP's threads, where nothing is said, wait by spinning: beside other work they take from each
// other the processor that they wait for. How they wait is read from the environment when their
// library is loaded, so that the program begins once more with it said. So is whether memory may
// come in large pages: a factor of 500 MB in small ones spends a fifth of its time on them.
// METIS, under CHOLMOD, calls itself: a stack of less than 256 kB ends it without a word.
#include <algorithm>
#include <cstddef>
#include <fcntl.h>
#include <initializer_list>
#include <sched.h>
#include <string_view>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

// Not there where the program is built without OpenBLAS.
extern "C" [[gnu::weak]] int openblas_get_num_threads();
extern "C" [[gnu::weak]] void openblas_set_num_threads(int);

namespace {

constexpr std::size_t mebibyte = 1 << 20;
constexpr std::size_t room_for_a_thread = 128 * mebibyte;
constexpr std::size_t room_for_the_rest = 16 * mebibyte;
constexpr rlim_t least_stack = mebibyte, usual_stack = 8 * mebibyte;

[[noreturn]] void end(std::string_view words) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, words.data(), words.size());
  ::_exit(1);
}

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

/// A small stack grows, as far as that is allowed.
void look_for_stack() {
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= least_stack) return;
  stack.rlim_cur = std::min(stack.rlim_max, usual_stack);
  if (stack.rlim_cur >= least_stack && ::setrlimit(RLIMIT_STACK, &stack) == 0) return;
  end("perifrac: the stack is too small to begin: 1 MB is the least; allow more (ulimit -s)\n");
}

/// A file that is opened where a standard one is closed would take its number, and what is printed.
/// Nothing can be written to these: a result that cannot be printed is still no success.
void look_for_standard_files() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(number, F_GETFD) >= 0) continue;
    [[maybe_unused]] const int opened = ::open("/dev/null", O_RDONLY);
  }
}

bool says_any(std::string_view entry, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(names, [&](auto name) { return entry.starts_with(name); });
}

/// Begins once more with threads that sleep where they wait and memory in large pages, unless the
/// environment says how either is to be. Where that cannot be, threads spin and pages are small.
void say_what_libraries_read(bool one_thread, char** arguments, char** environment) {
  static char asleep[] = "OMP_WAIT_POLICY=passive";
  static char large_pages[] = "GLIBC_TUNABLES=glibc.malloc.hugetlb=1";
  bool says_how_threads_wait = one_thread, says_pages = false;
  std::size_t count = 0;
  for (; environment[count] != nullptr; ++count) {
    const std::string_view entry = environment[count];
    if (says_any(entry, {"OMP_WAIT_POLICY=", "GOMP_SPINCOUNT="})) says_how_threads_wait = true;
    if (says_any(entry, {"GLIBC_TUNABLES="})) says_pages = true;
  }
  if (says_how_threads_wait && says_pages) return;
  const std::size_t bytes = (count + 3) * sizeof(char*);
  void* const place =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) return;
  char** const longer = static_cast<char**>(place);
  std::copy_n(environment, count, longer);
  if (!says_how_threads_wait) longer[count++] = asleep;
  if (!says_pages) longer[count++] = large_pages;
  ::execve("/proc/self/exe", arguments, longer);
  ::munmap(place, bytes);
}

void look_for_room(int, char** arguments, char** environment) {
  say_what_libraries_read(thread_count(environment) == 1, arguments, environment);
  look_for_standard_files();
  look_for_stack();
  const std::size_t buffers = std::max<std::size_t>(2, thread_count(environment));
  const std::size_t room = buffers * room_for_a_thread + room_for_the_rest;
  void* const place =
      ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (place == MAP_FAILED) {
    end("perifrac: out of memory before it began: it takes 128 MB of address space for every "
        "thread, and for two at the least; allow more (ulimit -v), or fewer threads "
        "(OMP_NUM_THREADS)\n");
  }
  ::munmap(place, room);
}

/// As every factorisation will, once libraries are there and nothing else is. A factor on one
/// thread takes a second buffer when it is first made.
[[gnu::constructor]] void take_buffers() {
  if (openblas_set_num_threads == nullptr) return;
  const int threads = openblas_get_num_threads();
  for (const int taken : {1, std::max(2, threads), threads}) openblas_set_num_threads(taken);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const first_of_all)(int, char**,
                                                                         char**) = look_for_room;

}  // namespace
