#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace perifrac {

/// Where the time and the memory of a run go. Code names its parts by ProfileScope and ProfilePart;
/// parts lie within each other. While no Profile lives, a part costs a look at a pointer: name
/// calls of modules and solvers so, never what is done to a point or a bond.
///
/// The thread that made it is the one it watches; parts on others are not seen.
class Profile {
 public:
  static constexpr int none = -1;

  /// What lies in the parts within it is left out of all its figures.
  struct Part {
    std::string name;
    int within = none;  ///< the part around it, by number
    std::int64_t calls = 0;
    double seconds = 0.0;      ///< wall time [s]
    double cpu_seconds = 0.0;  ///< of all threads meanwhile [s]
    std::int64_t bytes = 0;    ///< by which the heap grew, negative where it shrank
  };

  Profile();
  ~Profile();
  Profile(const Profile&) = delete;
  Profile& operator=(const Profile&) = delete;

  /// Of this thread; null where nobody asked for one.
  static Profile* active() { return active_; }

  /// From here until leave() what is done belongs to this part. `weighs`: so does what the heap
  /// grows by, which takes longer to find than the time.
  void enter(std::string_view name, bool weighs);
  void leave();

  /// Parts up to now, in the order in which they were first met, each after the one around it. The
  /// first, without a name, is what was in no part.
  const std::vector<Part>& parts();

  /// Of this process when the profile began [bytes].
  std::int64_t resident_at_start() const { return resident_at_start_; }

 private:
  using Clock = std::chrono::steady_clock;

  struct Open {
    int part;
    bool weighs;
  };

  int part_named(std::string_view name, int within);
  void book_time();
  void book_bytes();

  static thread_local Profile* active_;

  std::vector<Part> parts_;
  std::vector<Open> open_;  ///< innermost last
  Clock::time_point last_;
  double last_cpu_;
  std::int64_t last_heap_;
  std::int64_t resident_at_start_;
};

/// Times the rest of its block as a part.
class ProfileScope {
 public:
  explicit ProfileScope(std::string_view name) : ProfileScope(name, false) {}
  ~ProfileScope() {
    if (profile_ != nullptr) profile_->leave();
  }
  ProfileScope(const ProfileScope&) = delete;
  ProfileScope& operator=(const ProfileScope&) = delete;

 protected:
  ProfileScope(std::string_view name, bool weighs) : profile_(Profile::active()) {
    if (profile_ != nullptr) profile_->enter(name, weighs);
  }

 private:
  Profile* profile_;
};

/// Times and weighs it.
class ProfilePart : public ProfileScope {
 public:
  explicit ProfilePart(std::string_view name) : ProfileScope(name, true) {}
};

/// What this process holds in memory now [bytes]; 0 where the system does not say.
std::int64_t resident_bytes();

}  // namespace perifrac
