// Output files by extension: map_extensions() hold or show a map, .json is a report, .csv an
// iteration trace.
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

// The extensions of formats that hold a map or show one, in the order of messages, and then `also`:
// the one list behind help, refusals and require_writable().
std::vector<std::string> map_extensions(const std::vector<std::string>& also = {});
// "output: .vtu .obj, repeatable": help of -o.
std::string output_help(const std::vector<std::string>& extensions);
// Help of inputs, from the table of formats: meshes of surfaces, results, meshes of cells.
std::string surface_help();
std::string result_help();
std::string cells_help();
// --distortion FILE.csv
OptionRow distortion_option(std::string* path);
// Throws Error(Usage) where no output is named.
void require_some_output(const std::vector<std::string>& outputs,
                         const std::vector<std::string>& extensions);

// An output option: the file that it names, and the extensions that it takes. Empty paths stand for
// options not given.
struct OutputNames {
  std::vector<std::string> paths, extensions;
  bool may_be_report = true;  // a .json is a report of the run
};

// Before any work: refuses outputs, the report of `common` among them, that have another extension
// or cannot be written, or that are one file under two names; without --force also those that would
// replace one of `inputs`, a file that one of these names (a texture, a buffer), or a mesh that
// majorant did not write. Throws Error(Usage); Stopped.
void require_writable(const CommonOptions& common, const std::vector<OutputNames>& outputs,
                      const std::vector<std::string>& inputs, const StopCheck& stop = {});

// Files written one by one: where one fails, the others are written all the same.
class WrittenFiles {
 public:
  // Calls write() and remembers what it throws.
  void write(const std::string& path, const std::function<void()>& write);
  // Remembers one that is written with another one.
  void add(const std::string& path);
  bool has(const std::string& path) const;
  // "wrote a.vtu (12.3 kB), a.svg (4.5 MB)" on stderr; nothing where nothing was written.
  void say_sizes() const;  // written, and as it should be
  // [{"file", "written", "message"}], in order.
  Json to_json() const;
  // Where a file is missing, says on stderr which and why, and which were written. code: of all
  // else; a success (0, 4) becomes 1, or 5 where a file failed its verification.
  int conclude(int code) const;

 private:
  struct Entry {
    std::string path, failure;  // empty: written
    ExitCode code;
  };
  std::vector<Entry> entries_;
};

// Options of single formats, as the user gave them.
struct FormatOptions : MapFormats {
  std::string image;  // file of png.image, or empty

  // Reads the file that --image names. Throws Error(Unreadable) where it is no PNG.
  void read_image(const StopCheck& stop = {});

  // Returns whether --align asks for a map that is turned itself: some of these files hold its
  // coordinates.
  bool turns_map(const std::vector<std::string>& files) const;

  void add_to(CLI::App& verb);  // --refine --vtu --msh --grid --color-range ...
  // What drawings look like alone: --color-range --color-by --size --edges --legend --transparent.
  void add_drawing_to(CLI::App& verb);
  std::string first_given() const;  // "--size"; empty: none was
  // Throws Error(Usage) for one of these that says something of formats that no file has.
  void require_effect(const std::vector<std::string>& files) const;

 private:
  // An option of some formats alone, which belongs to the verb.
  struct OfFormats {
    const CLI::Option* option;
    std::vector<std::string> extensions;
  };

  void add_pictures_to(CLI::App& verb);
  // What else may have been meant by an option, for the end of a message.
  std::string other_meaning(const std::string& option) const;

  const CLI::App* verb_ = nullptr;  // that has the options
  std::vector<OfFormats> options_;
};

// "out.msh: does not hold the surface (--msh surface does)": where anything is left out.
void say_left_out(const std::string& path, const std::vector<std::string>& what);

// Written atomically; to stdout where the name is kStandardOutput.
void write_json(const std::string& path, const Json& json);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
