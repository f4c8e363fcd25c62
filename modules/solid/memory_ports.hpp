#pragma once

#include "core/module/port_table.hpp"
#include "modules/solid/material/nonlinear_response.hpp"
#include "modules/solid/whole_solid.hpp"

namespace perifrac {

/// The ports of rock with a memory, which must stay: out `material_memory`, the numbers that its
/// law remembers at every point, and `material_heat` [J] (per metre in 2D), what it turned into
/// heat.
inline void add_memory_ports(NonlinearResponse& rock, const PointSet& points, int dimension,
                             PortTable& ports) {
  ports.out({.name = "material_memory", .unit = "1", .components = rock.memory_size()},
            [&rock, &points] {
              return PortView{&points, rock.memory()};
            });
  ports.total(total_port("material_heat", "J", PortRole::energy_dissipated, dimension), whole_solid,
              [&rock] { return rock.heat(); });
}

}  // namespace perifrac
