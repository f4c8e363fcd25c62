#include "modules/fluid/openings/named_box.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace perifrac {

KeyTable named_box_keys(const std::string& list, const std::string& meaning) {
  return {
      {.path = list + "[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of " + meaning + "."},
      {.path = list + "[].from",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its low corner."},
      {.path = list + "[].to",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its high corner."},
  };
}

template <int D>
Region<D> read_named_box(const Section& section, const std::string& path) {
  Region<D> box;
  box.name = section.text(path + ".name");
  std::ranges::copy(section.numbers(path + ".from"), box.from.begin());
  std::ranges::copy(section.numbers(path + ".to"), box.to.begin());
  for (int a = 0; a < D; ++a) {
    if (box.from[a] < box.to[a]) continue;
    section.fail(path + ".to",
                 fmt::format("{:g} m is not above `from`, {:g} m, along axis {}", box.to[a],
                             box.from[a], "xyz"[a]),
                 "the high corner of a box");
  }
  return box;
}

template Region<2> read_named_box<2>(const Section&, const std::string&);
template Region<3> read_named_box<3>(const Section&, const std::string&);

}  // namespace perifrac
