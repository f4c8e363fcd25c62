#include <fmt/format.h>

#include "app/command_pages.hpp"
#include "app/run/version.hpp"

namespace perifrac {

namespace {

/// As it shall stand in the page: no backslash, hyphen or beginning of a line means anything else.
std::string roff(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else
      result += c;
  }
  return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string option_heading(const CLI::Option& option) {
  std::string text;
  for (const std::string& name : option.get_lnames()) {
    text += fmt::format("{}\\fB\\-\\-{}\\fR", text.empty() ? "" : ", ", roff(name));
  }
  if (text.empty()) text = fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
  const bool takes_value = !option.get_lnames().empty() && option.get_type_size() > 0;
  if (takes_value) text += fmt::format(" \\fI{}\\fR", roff(type_of(option)));
  return text;
}

std::string section_of(const CLI::App& verb) {
  std::string heading = "perifrac " + verb.get_name(), options;
  for (const CLI::Option* option : verb.get_options({})) {
    if (option->get_positional()) heading += ' ' + option->get_name(true);
    if (option->get_lnames() == std::vector<std::string>{"help"}) continue;
    options +=
        fmt::format(".TP\n{}\n{}\n", option_heading(*option), roff(option->get_description()));
  }
  return fmt::format(".SS {}\n{}.\n{}", roff(heading), roff(verb.get_description()), options);
}

constexpr const char* after_verbs = R"(.SH FILES
A run leaves a folder, runs/SCENE unless \fB\-\-output\fR says otherwise:
.TP
\fBreport.png\fR, \fBreport.html\fR
picture; page with charts and a slider over the frames
.TP
\fBhistory.csv\fR
a row a window, with units in the header
.TP
\fBsummary.json\fR
the scene as run, counts, work, balances, errors and warnings
.TP
\fBframes/*.hdf.series\fR
fields of the body and of cracks, for ParaView 5.11 or later
.TP
\fBcheckpoint_*.h5\fR
the last two states that \fB\-\-restart\fR goes on from bit for bit
.PP
\fBperifrac info\fR says what any of these holds.
.SH ENVIRONMENT
.TP
\fBOMP_NUM_THREADS\fR
threads, where \fB\-\-threads\fR is not given
.TP
\fBOMP_WAIT_POLICY\fR, \fBGOMP_SPINCOUNT\fR
how threads wait; they sleep where neither is set
.TP
\fBGLIBC_TUNABLES\fR
where it is not set, memory may come in large pages (glibc.malloc.hugetlb=1)
.TP
\fBPERIFRAC_INSTRUCTIONS\fR
the instruction set that an installed program takes: x86\-64\-v4, x86\-64\-v3 or x86\-64; else the best that the processor has. Results differ in their last bits from set to set
.TP
\fBPERIFRAC_PYTHON\fR
a Python with matplotlib and h5py for pictures and pages, in place of /usr/bin/python3
.TP
\fBNO_COLOR\fR
no colours on a terminal
.SH EXIT STATUS
.TP
\fB0\fR
done
.TP
\fB1\fR
numerical failure, or a result that cannot be written
.TP
\fB2\fR
usage or scene; nothing was written
.TP
\fB130\fR, \fB143\fR
stopped by a signal, with a checkpoint written
.SH EXAMPLES
.nf
perifrac run \-\-example mandel
perifrac new kgd \-\-output mine.yaml
perifrac check mine.yaml
perifrac run mine.yaml \-\-set crack_fluid.viscosity="1 mPa s"
perifrac info runs/mine
.fi
.SH SEE ALSO
The pages in share/doc/perifrac, among them configuration.md: every key of a scene.
)";

}  // namespace

std::string man_page(const CLI::App& app) {
  std::string text = fmt::format(
      ".TH PERIFRAC 1 \"\" \"perifrac {}\" \"User Commands\"\n"
      ".SH NAME\nperifrac \\- {}\n"
      ".SH SYNOPSIS\n.B perifrac\n.I VERB\n[\\fIARGUMENTS\\fR]\n"
      ".SH DESCRIPTION\nA scene is a YAML file. It names what there is of porous rock, pore flow, "
      "free fluid, and cracks with fluid in them; \\fBperifrac\\fR simulates it by peridynamics.\n"
      ".SH COMMANDS\n",
      version, roff(app.get_description()));
  for (const CLI::App* verb : app.get_subcommands({})) text += section_of(*verb);
  return text + after_verbs;
}

}  // namespace perifrac
