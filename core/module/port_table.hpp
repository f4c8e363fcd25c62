#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/module/port.hpp"

namespace perifrac {

/// The ports of a module, each beside what reads it; its PortId is its place here.
class PortTable {
 public:
  using Read = std::function<PortView()>;
  /// Makes room for an input that some module writes.
  using Connect = std::function<void()>;

  void in(Port port, Connect connect, Read read) {
    add(std::move(port), PortDirection::in, std::move(read), std::move(connect));
  }
  void out(Port port, Read read) { add(std::move(port), PortDirection::out, std::move(read)); }
  /// A field on `where`, found when it is asked for.
  void found(Port port, const PointSet& where, std::function<void(std::vector<double>&)> find) {
    out(std::move(port),
        [&where, find = std::move(find), values = std::vector<double>()]() mutable {
          find(values);
          return PortView{&where, values};
        });
  }
  /// One value on `where`, found when it is asked for.
  void total(Port port, const PointSet& where, std::function<double()> find) {
    out(std::move(port), [&where, find = std::move(find), value = 0.0]() mutable {
      value = find();
      return PortView{&where, {&value, 1}};
    });
  }

  std::span<const Port> list() const { return ports_; }
  PortView view(PortId id) { return entries_[id].read(); }
  void connect(PortId in) { entries_[in].connect(); }

 private:
  struct Entry {
    Read read;
    Connect connect;
  };

  void add(Port port, PortDirection direction, Read read, Connect connect = {}) {
    port.direction = direction;
    ports_.push_back(std::move(port));
    entries_.push_back({std::move(read), std::move(connect)});
  }

  std::vector<Port> ports_;
  std::vector<Entry> entries_;
};

}  // namespace perifrac
