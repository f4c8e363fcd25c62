#include "core/state/snapshot.hpp"

#include <set>
#include <stdexcept>

#include "core/base/digest.hpp"

namespace perifrac {
namespace {

/// What saving and restoring share: a field may be met once only.
class OnceVisitor : public StateVisitor {
 public:
  using StateVisitor::StateVisitor;
  bool met(const std::string& name) const { return met_.contains(name); }

 protected:
  void meet(const std::string& name) {
    if (!met_.insert(name).second) {
      throw std::logic_error("state field '" + name + "' is visited twice");
    }
  }

 private:
  std::set<std::string> met_;
};

class Saver final : public OnceVisitor {
 public:
  Saver(Snapshot::Fields& fields, bool takes_guesses)
      : OnceVisitor(takes_guesses), fields_(fields) {}

 private:
  void real(const std::string& name, std::vector<double>& values) override { copy(name, values); }
  void integer(const std::string& name, std::vector<std::int64_t>& values) override {
    copy(name, values);
  }

  template <class Number>
  void copy(const std::string& name, const std::vector<Number>& values) {
    meet(name);
    Snapshot::Values& held = fields_[name];
    if (auto* same_type = std::get_if<std::vector<Number>>(&held)) {
      *same_type = values;
    } else {
      held = values;
    }
  }

  Snapshot::Fields& fields_;
};

class Restorer final : public OnceVisitor {
 public:
  Restorer(const Snapshot::Fields& fields, bool takes_guesses)
      : OnceVisitor(takes_guesses), fields_(fields) {}

 private:
  void real(const std::string& name, std::vector<double>& values) override { copy(name, values); }
  void integer(const std::string& name, std::vector<std::int64_t>& values) override {
    copy(name, values);
  }

  template <class Number>
  void copy(const std::string& name, std::vector<Number>& values) {
    meet(name);
    const auto held = fields_.find(name);
    if (held == fields_.end()) {
      throw std::logic_error("state field '" + name + "' was not saved");
    }
    const auto* same_type = std::get_if<std::vector<Number>>(&held->second);
    if (same_type == nullptr) {
      throw std::logic_error("state field '" + name + "' was saved with another type");
    }
    values = *same_type;
  }

  const Snapshot::Fields& fields_;
};

}  // namespace

void Snapshot::save(const StateWalk& walk) {
  Saver saver(fields_, takes_guesses_);
  walk(saver);
  std::erase_if(fields_, [&](const auto& field) { return !saver.met(field.first); });
}

void Snapshot::restore(const StateWalk& walk) const {
  Restorer restorer(fields_, takes_guesses_);
  walk(restorer);
  for (const auto& [name, values] : fields_) {
    if (!restorer.met(name)) {
      throw std::logic_error("state field '" + name + "' was saved but is not visited");
    }
  }
}

std::int64_t Snapshot::digest() const {
  Digest digest;
  for (const auto& [name, values] : fields_) {
    std::visit([&](const auto& array) { digest.add(array); }, values);
  }
  return digest.value();
}

}  // namespace perifrac
