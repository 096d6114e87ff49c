#include "app/probe_points.h"

#include <istream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "base/error.h"
#include "dlm/dlm_reader.h"
#include "dlm/probe.h"

namespace lucarne {
namespace {

struct Question {
  Vec3d position, normal;
};

Question parse(const std::string& line, int number) {
  std::istringstream text(line);
  Question q;
  std::string rest;
  if (!(text >> q.position.x >> q.position.y >> q.position.z >> q.normal.x >> q.normal.y >> q.normal.z) || text >> rest)
    throw InputError("standard input, line " + std::to_string(number) + ": expected six numbers, x y z nx ny nz");
  return q;
}

std::string toText(const ProbeAnswer& a) {
  std::ostringstream text;
  if (!a.onSurface) return "no surface here";
  text << "chart " << a.chart << (a.back ? " back" : " front") << "  irradiance " << a.irradiance.x << " " << a.irradiance.y << " "
       << a.irradiance.z << " lx  error " << a.standardError << " lx, " << 100 * a.relativeError << " %  photons " << a.photons << "  directions "
       << a.directions.size();
  return text.str();
}

}  // namespace

void probePoints(const std::filesystem::path& path, std::istream& in, std::ostream& out, bool asText) {
  const Dlm dlm = readDlm(path);
  const Prober prober(dlm);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const Question q = parse(line, number);
    const ProbeAnswer answer = prober.probe(q.position, q.normal);
    out << (asText ? toText(answer) : toJson(answer).dump()) << "\n" << std::flush;
  }
}

}  // namespace lucarne
