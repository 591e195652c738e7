// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the Signorini authors

// signorini-map: the contact mapping of two surface files, without finite elements.

#include <signorini/algebra/input_error.h>
#include <signorini/mesh/surface_file.h>
#include <signorini/output/field_output.h>
#include <signorini/output/json_writer.h>
#include <signorini/output/summary.h>
#include <signorini/surface/contact_mapping.h>
#include <signorini/surface/mapping_quality.h>

#include <chrono>
#include <filesystem>
#include <iostream>

#include <sys/resource.h>

namespace
{
  using namespace Signorini;

  const char *const usage =
      "usage: signorini-map NONMORTAR MORTAR [--report] [--vtu FILE] [--json FILE] [--strict]\n"
      "\n"
      "Maps the mortar surface onto the nonmortar surface along its continuous normal "
      "field and computes the\n"
      "overlay. The files are triangulated surfaces: OFF, STL, OBJ, PLY or gmsh; the "
      "normals of the two point\n"
      "towards each other.\n"
      "\n"
      "  --report     what is covered, angles, gaps, and what could not be mapped (the "
      "default without --json)\n"
      "  --vtu FILE   the overlay with the way to the image and the gap, for ParaView\n"
      "  --json FILE  the figures\n"
      "  --strict     fail where the mapping has errors: lost, torn or turned pieces, a "
      "tiling that is not exact\n"
      "  --help, --version\n";

  struct CommandLine
  {
    std::vector<std::string> files;
    std::string              vtu, json;
    bool                     report = false, strict = false;
  };

  CommandLine parse(const int argc, char **argv)
  {
    CommandLine line;
    for (int i = 1; i < argc; ++i)
      {
        const std::string word = argv[i];
        if (word == "--report")
          line.report = true;
        else if (word == "--strict")
          line.strict = true;
        else if (word == "--vtu" || word == "--json")
          {
            if (++i == argc)
              throw InputError(word + " needs the name of a file.");
            (word == "--vtu" ? line.vtu : line.json) = argv[i];
          }
        else if (word.size() > 1 && word[0] == '-')
          throw InputError("there is no option " + word + ". See signorini-map --help.");
        else
          line.files.push_back(word);
      }
    if (line.files.size() != 2)
      throw InputError("two surface files are needed. See signorini-map --help.");
    return line;
  }

  /// Writes a file as a whole: under another name until it is complete.
  template <typename F>
  void write_file(const std::string &name, const F &writer)
  {
    const std::string part = name + ".part";
    std::ofstream     out(part);
    if (out)
      writer(out);
    out.close();
    std::error_code error;
    if (out)
      std::filesystem::rename(part, name, error);
    if (!out || error)
      {
        std::filesystem::remove(part, error);
        throw InputError("the file " + name + " cannot be written.");
      }
  }

  void write_json(std::ostream &out, const MappingReport &report, const double seconds)
  {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    JsonWriter json(out);
    json.begin('{');
    write_mapping_report(json, report);
    json.number("time_s", seconds);
    json.number("peak_memory_bytes", 1024. * used.ru_maxrss);
    json.end('}');
    out << '\n';
  }

  void run(const CommandLine &line)
  {
    const SurfaceMesh    nonmortar = read_surface(line.files[0]), mortar = read_surface(line.files[1]);
    const auto           start = std::chrono::steady_clock::now();
    const ContactMapping mapping(nonmortar, mortar);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!line.json.empty())
      write_file(line.json, [&](std::ostream &out) { write_json(out, mapping.report(), seconds); });
    if (!line.vtu.empty())
      write_file(line.vtu,
                 [&](std::ostream &out) { write_overlay(out, nonmortar, mortar, mapping.overlay()); });
    if (line.report || line.json.empty())
      {
        std::cout << line.files[0] << ": " << nonmortar.triangles.size() << " triangles, " << line.files[1]
                  << ": " << mortar.triangles.size() << " triangles, mapped in " << seconds << " s\n";
        print_mapping(std::cout, mapping.report(), assess_mapping(mapping, nonmortar, mortar));
      }
    if (mapping.report().n_pairs == 0)
      throw InputError(
          "the surfaces do not face each other anywhere: there is not a single overlay cell. Normals "
          "must point towards each other.");
    if (const std::string errors = describe_errors(mapping.report()); !errors.empty())
      {
        if (line.strict)
          throw InputError("the mapping has errors: " + errors + ".");
        std::cerr << "signorini-map: WARNING: the mapping has errors: " << errors
                  << ". It is not one-to-one there: mend the surfaces. (--strict makes this an error.)\n";
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  for (int i = 1; i < argc; ++i)
    if (const std::string word = argv[i]; word == "--help" || word == "--version")
      {
        std::cout << (word == "--help" ? usage : "signorini-map " SIGNORINI_VERSION "\n");
        return 0;
      }
  try
    {
      run(parse(argc, argv));
    }
  catch (const std::exception &e)
    {
      std::cerr << "signorini-map: error: " << e.what() << std::endl;
      return 1;
    }
  return 0;
}
