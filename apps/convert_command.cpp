// majorant convert RESULT -o OUT...: other formats of a finished map, without solving again.
#include <CLI/App.hpp>
#include <memory>

#include "apps/command.h"
#include "apps/outputs.h"
#include "majorant/io/read_map.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string input, positional_output;
  std::vector<std::string> outputs;
  int refine = 0;
};

int convert(Request request) {
  if (!request.positional_output.empty()) request.outputs.push_back(request.positional_output);
  if (request.outputs.empty())
    throw Error(ErrorKind::Usage, "no output file; add -o OUT.obj (or .svg .vtu)");
  require_writable(request.outputs, {".vtu", ".obj", ".svg"});
  request.common.apply();
  const MapFile map = read_map(request.input);
  for (const std::string& path : request.outputs) write_map(path, map, nullptr, request.refine);
  return kSuccess;
}

}  // namespace

void add_convert(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("convert", "write a finished map in other formats");
  verb.add_option("result", request->input, "result: .vtu, or .obj with vt")->required();
  verb.add_option("output", request->positional_output, "output file, same as -o");
  verb.add_option("-o,--output", request->outputs, "output: .vtu .obj .svg, repeatable")
      ->allow_extra_args(false);
  verb.add_option("--refine", request->refine, "pieces per edge in OBJ output")
      ->check(CLI::Range(1, 20));
  request->common.add_to(verb);
  verb.footer("Example: majorant convert bunny.vtu -o bunny.obj --refine 8");
  verb.callback([request, run] { *run = [request] { return convert(*request); }; });
}

}  // namespace majorant::app
