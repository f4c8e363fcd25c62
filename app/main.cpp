#include "app/command_line.hpp"
#include "core/base/ranks.hpp"

int main(int argc, char** argv) {
  perifrac::ranks::Session session;
  return session.end(perifrac::run_command_line(argc, argv));
}
