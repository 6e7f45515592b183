// Options that several commands have, with the same words.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace holdfast::cli {

/// Adds --threads.
void add_threads(CLI::App& command, unsigned& threads);

/// Adds --report, a file of JSON; `help` says what is in it.
void add_report(CLI::App& command, std::filesystem::path& report, const char* help);

/// Adds --output, a volume file.
void add_volume_output(CLI::App& command, std::filesystem::path& output);

/// Adds --format of such a file.
void add_volume_format(CLI::App& command, std::string& format);

/// Adds --input-format; `format` is what it gives, as in "Surface format".
void add_input_format(CLI::App& command, std::string& input_format, const std::string& format);

/// Adds --quiet for a command that says nothing then unless something is wrong.
CLI::Option* add_quiet(CLI::App& command, bool& quiet);

}  // namespace holdfast::cli
