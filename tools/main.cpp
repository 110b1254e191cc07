#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "geometry/input_error.h"
#include "geometry/output_error.h"
#include "gpu/core/error.h"
#include "tools/verb.h"

namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 success; 1 the job ran and failed; 2 wrong usage or input; 3 no method meets "
    "the\n"
    "budget; 4 no suitable device, device lost, out of memory; 5 output not written; 130 "
    "interrupted.";

int fail(int code, const char* what) {
  std::fprintf(stderr, "parity: %s\n", what);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Parity: computer graphics twice, on Vulkan and on the CPU, and the proof that both agree"};
  app.name("parity");
  app.set_version_flag("--version", "parity " PARITY_VERSION);
  app.require_subcommand(1);
  app.failure_message([](const CLI::App*, const CLI::Error& error) {
    return "parity: " + std::string(error.what()) + " (--help says more)\n";
  });
  app.footer(exit_codes);
  int exit_code = 0;
  parity::tools::add_devices_verb(app, exit_code);
  parity::tools::add_render_verb(app, exit_code);
  parity::tools::add_list_verb(app, exit_code);
  parity::tools::add_check_verb(app, exit_code);
  parity::tools::add_chart_verb(app, exit_code);
  parity::tools::add_map_verb(app, exit_code);
  parity::tools::add_faults_verb(app, exit_code);
  parity::tools::add_diff_verb(app, exit_code);
  parity::tools::add_mesh_verb(app, exit_code);
  parity::tools::add_sim_verb(app, exit_code);
  parity::tools::add_spectrum_verb(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : 2;
  } catch (const parity::gpu::Error& error) {
    return fail(4, error.what());
  } catch (const parity::InputError& error) {
    return fail(2, error.what());
  } catch (const parity::OutputError& error) {
    return fail(5, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(2, error.what());
  } catch (const std::bad_alloc&) {
    return fail(4, "out of memory");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
  return exit_code;
}
