#include "core/base/ranks.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <mpi.h>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>

#include "core/base/errors.hpp"
#include "core/base/require.hpp"

namespace perifrac::ranks {

namespace {

int count_ = 1;
int own_ = 0;
int count_here_ = 1;
Index points_worth_ranks_ = 2000;
int spoken_ = -1;  ///< file that holds what this process had to say, where it is not the first
int heard_ = -1;   ///< the standard error that it had
bool is_alone_ = false;

/// What mpirun or srun tell those that they start.
bool is_one_of_many() {
  constexpr std::array names{"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"};
  for (const char* const name : names) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

void fall_silent() {
  std::fflush(nullptr);
  heard_ = dup(STDERR_FILENO);
  spoken_ = memfd_create("stderr", 0);
  if (spoken_ >= 0) dup2(spoken_, STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0) return;
  dup2(nowhere, STDOUT_FILENO);
  close(nowhere);
}

void say_what_was_held_back() {
  if (spoken_ < 0) return;
  std::fflush(nullptr);
  std::array<char, 4096> text;
  lseek(spoken_, 0, SEEK_SET);
  for (ssize_t size = 0; (size = read(spoken_, text.data(), text.size())) > 0;) {
    if (write(heard_, text.data(), static_cast<std::size_t>(size)) != size) return;
  }
}

/// All have come to `request` within ten seconds.
bool is_met_soon(MPI_Request& request) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  for (int met = 0; std::chrono::steady_clock::now() < end;) {
    MPI_Test(&request, &met, MPI_STATUS_IGNORE);
    if (met != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

int count() { return count_; }
int own() { return own_; }
bool divides(Index points) { return count_ > 1 && points >= points_worth_ranks_; }

Session::Session() {
  if (!is_one_of_many()) return;
  int granted = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  MPI_Comm_rank(MPI_COMM_WORLD, &own_);
  MPI_Comm here;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, own_, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &count_here_);
  MPI_Comm_free(&here);
  // For tests, whose bodies are small.
  if (const char* const least = std::getenv("PERIFRAC_LEAST_DIVIDED")) {
    points_worth_ranks_ = std::max(1, std::atoi(least));
  }
  if (own_ > 0) fall_silent();
}

Session::~Session() {
  int is_there = 0;
  MPI_Initialized(&is_there);
  if (is_there != 0) MPI_Finalize();
}

int Session::end(int code) {
  if (count_ == 1) return code;
  // The most, and that of the first, which has spoken for all that end as it does.
  std::array<int, 2> codes{code, own_ == 0 ? code : 0};
  MPI_Request request;
  MPI_Iallreduce(MPI_IN_PLACE, codes.data(), 2, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
  if (code == 0) {
    MPI_Wait(&request, MPI_STATUS_IGNORE);  // others may have more to do, and say so if they fail
    return codes[0];
  }
  const bool are_all_here = is_met_soon(request);
  if (!are_all_here || codes[1] == 0) say_what_was_held_back();
  if (!are_all_here) MPI_Abort(MPI_COMM_WORLD, code);
  return codes[0];
}

void on_first(const std::function<void()>& work) {
  std::exception_ptr failure;
  if (is_first()) {
    is_alone_ = true;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    is_alone_ = false;
  }
  if (largest(failure != nullptr) == 0) return;
  if (failure) std::rethrow_exception(failure);
  throw OutputError("results", "the first process could not write");
}

void gather(std::span<double> values, std::span<const Index> bounds) {
  require(!is_alone_, "a divided loop is done by all processes");
  require(bounds.back() <= std::ssize(values), "values of all processes");
  std::vector<int> sizes;
  for (int rank = 0; rank < count_; ++rank) sizes.push_back(bounds[rank + 1] - bounds[rank]);
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), sizes.data(), bounds.data(),
                 MPI_DOUBLE, MPI_COMM_WORLD);
}

std::int64_t largest(std::int64_t own) {
  require(!is_alone_, "processes agree together");
  if (count_ > 1) MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
  return own;
}

double of_first(double own) {
  require(!is_alone_, "processes agree together");
  if (count_ > 1) MPI_Bcast(&own, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return own;
}

int count_here() { return count_here_; }

void wait_for_all() {
  if (count_ > 1) MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace perifrac::ranks
