#include "python/bindings/bindings.hpp"

#include <omp.h>

#include "app/installation/data_folder.hpp"
#include "app/report/report.hpp"
#include "app/run/build_info.hpp"
#include "app/run/version.hpp"
#include "python/bindings/errors.hpp"
#include "python/bindings/python_module.hpp"
#include "python/bindings/python_scene.hpp"
#include "python/bindings/python_simulation.hpp"

namespace perifrac {

namespace py = pybind11;

void bind_all(py::module_& module) {
  name_own_unit_database();
  bind_errors();
  bind_scene(module);
  bind_modules(module);
  bind_simulation(module);
  module.attr("version") = version;
  module.attr("instruction_set") = instruction_set();
  module.def(
      "report",
      [](const std::string& folder) {
        const py::gil_scoped_release others_may_run;
        return make_report(folder, true) == 0;
      },
      py::arg("folder"),
      "Makes report.png and report.html of a run's folder; False where that fails.");
  module.def(
      "set_threads",
      [](int count) {
        if (count < 1) throw py::value_error("set_threads: expected a number of threads from 1");
        omp_set_num_threads(count);
      },
      py::arg("count"), "Threads of runs from now on; results do not depend on it.");
}

}  // namespace perifrac
