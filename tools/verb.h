#pragma once

#include <CLI/CLI.hpp>

/// The program's verbs, one file each. A verb adds its subcommand; when the subcommand is chosen
/// its callback does the work and sets the exit code (0 success; 1 the job ran and failed; 3 no
/// method meets the budget; 5 output not written). It throws InputError or std::invalid_argument
/// for what becomes 2, gpu::Error for 4.
namespace parity::tools {

void add_devices_verb(CLI::App& app, int& exit_code);
void add_render_verb(CLI::App& app, int& exit_code);
void add_list_verb(CLI::App& app, int& exit_code);
void add_check_verb(CLI::App& app, int& exit_code);
void add_chart_verb(CLI::App& app, int& exit_code);
void add_map_verb(CLI::App& app, int& exit_code);
void add_faults_verb(CLI::App& app, int& exit_code);
void add_diff_verb(CLI::App& app, int& exit_code);
void add_mesh_verb(CLI::App& app, int& exit_code);
void add_sim_verb(CLI::App& app, int& exit_code);
void add_spectrum_verb(CLI::App& app, int& exit_code);

}  // namespace parity::tools
