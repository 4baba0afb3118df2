// Output files, by extension: maps and pictures (map_extensions()), .json reports, .csv iteration
// traces.
//
//   const std::vector<std::string> files{"a.vtu", "a.obj"};
//   require_writable(common, {{files, map_extensions()}}, {path});   // before any work
//   WrittenFiles written;
//   for (const std::string& path : files)
//     written.write(path, [&] { write_map(path, file, nullptr, FormatOptions()); });
//   return written.conclude(kSuccess);                               // says what failed
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "apps/arguments/option_table.h"
#include "apps/command.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/io/atomic_file.h"

namespace majorant::app {

// Returns the extensions of formats that hold or show a map, in the order of messages, then `also`.
// Help, refusals and require_writable() all use this list.
std::vector<std::string> map_extensions(const std::vector<std::string>& also = {});
// Returns the help of -o: "output: .vtu .obj, repeatable".
std::string output_help(const std::vector<std::string>& extensions);
// Return the help of inputs from the table of formats: surface meshes, results, meshes of cells.
std::string surface_help();
std::string result_help();
std::string cells_help();
// Returns the row of --distortion FILE.csv.
OptionRow distortion_option(std::string* path);
// Throws Error(Usage) if no output is named.
void require_some_output(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& extensions);

// The files of an output option and the extensions that it accepts. Empty paths stand for options
// not given.
struct OutputNames {
  std::vector<std::string> paths, extensions;
  bool may_be_report = true;  // accepts .json, a report of the run
};

// Checks the outputs before any work, including the report of `common`. Throws Error(Usage) for
// other extensions, for files that cannot be written, and for two names of one file. Without
// --force it also refuses to replace one of `inputs`, a file that these name (a texture, a buffer),
// or a mesh that majorant did not write. Throws Stopped.
void require_writable(const CommonOptions& common, const std::vector<OutputNames>& outputs,
                      const std::vector<std::string>& inputs, const StopCheck& stop = {});

// Output files, written one by one. If one fails, the others are still written.
class WrittenFiles {
 public:
  // Calls write() and records its exception.
  void write(const std::string& path, const std::function<void()>& write);
  // Records a file that was written together with another one.
  void add(const std::string& path);
  bool has(const std::string& path) const;
  // Prints "wrote a.vtu (12.3 kB), a.svg (4.5 MB)" on stderr, if any file was written.
  void say_sizes() const;  // whether the file was written and passed its verification
  // Returns [{"file", "written", "message"}], in order.
  Json to_json() const;
  // Prints which files are missing and why, and which were written. code: the exit code of the rest
  // of the run. For missing files a success (0, 4) becomes 1, or 5 if a file failed its
  // verification. speaker: opens the line.
  int conclude(int code, const std::string& speaker = "majorant") const;

 private:
  struct Entry {
    std::string path, failure;  // failure is empty for written files
    ExitCode code;
  };
  std::vector<Entry> entries_;
};

// Options of particular formats, as the user gave them.
struct FormatOptions : MapFormats {
  std::string image;  // file name of png.image, or empty

  // Reads the file that --image names. Throws Error(Unreadable) if it is not a PNG.
  void read_image(const StopCheck& stop = {});

  // Returns whether --align turns the map itself: true if one of these files holds its coordinates.
  bool turns_map(const std::vector<std::string>& files) const;

  void add_to(CLI::App& verb);  // adds --refine --vtu --msh --grid --color-range ...
  // Adds the options of drawings: --color-range --color-by --size --edges --legend --transparent.
  void add_drawing_to(CLI::App& verb);
  std::string first_given() const;  // the first given option, "--size"; empty if there is none
  // Throws Error(Usage) if an option applies to formats that no file has.
  void require_effect(const std::vector<std::string>& files) const;

 private:
  // An option of the verb that applies to some formats only.
  struct OfFormats {
    const CLI::Option* option;
    std::vector<std::string> extensions;
  };

  void add_pictures_to(CLI::App& verb);
  // Returns another possible meaning of an option, for the end of a message.
  std::string other_meaning(const std::string& option) const;

  const CLI::App* verb_ = nullptr;  // the verb of the options
  std::vector<OfFormats> options_;
};

// Prints "out.msh: does not hold the surface (--msh surface does)" if anything is left out.
void say_left_out(const std::string& path, const std::vector<std::string>& what);

// Writes JSON atomically, or to stdout if the name is kStandardOutput.
void write_json(const std::string& path, const Json& json);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
