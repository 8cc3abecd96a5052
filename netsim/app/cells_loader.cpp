#include "netsim/app/cells_loader.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "common/base/suggestions.h"
#include "common/transport/digest.h"
#include "hal/io/motion_file.h"
#include "netsim/cells/shipped_cells.h"
#include "proto/io/scene_file.h"
#include "proto/text/cells_text.h"
#include "proto/text/scene_text.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kDigits = 16;

InputErrors one(InputError place, std::string message) {
  place.message = std::move(message);
  return {std::move(place)};
}

/// Adds the content of a file. @return why it cannot be read; empty: it was
std::string add_file(const std::string& path, transport::Digest& digest) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::fopen(path.c_str(), "rbe"), std::fclose};
  if (!file) return path + " cannot be read: " + std::strerror(errno);
  std::array<char, 65536> part;
  std::size_t n = 0;
  while ((n = std::fread(part.data(), 1, part.size(), file.get())) > 0) digest.add({part.data(), n});
  return std::ferror(file.get()) != 0 ? path + " cannot be read to its end" : std::string{};
}

/// Returns a file named in a file of cells: relative to its folder.
std::string beside(const std::string& cells_file, const std::string& named) {
  const std::filesystem::path path{named};
  if (path.is_absolute()) return named;
  return (std::filesystem::path(cells_file).parent_path() / path).string();
}

bool is_path(const std::string& name) { return name.find_first_of("/.") != std::string::npos; }

/// Returns the text of the file, and the name for messages.
std::expected<std::pair<std::string, std::string>, InputErrors> text_of(const std::string& path_or_name) {
  std::error_code error;
  if (is_path(path_or_name) || std::filesystem::exists(path_or_name, error)) {
    auto text = read_text_file(path_or_name);
    if (!text) return std::unexpected(text.error());
    return std::pair{std::move(*text), path_or_name};
  }
  if (const EmbeddedFile* const shipped = find_shipped_cells(path_or_name); shipped != nullptr)
    return std::pair{std::string(shipped->text), path_or_name + ".textproto"};
  return std::unexpected(
      one({}, "there is no file of cells " + path_or_name + "; " + suggest_name(path_or_name, shipped_cells())));
}

}  // namespace

std::expected<LoadedCells, InputErrors> load_cells(const std::string& path_or_name) {
  const auto text = text_of(path_or_name);
  if (!text) return std::unexpected(text.error());
  auto spec = parse_cells_text(text->first, text->second);
  if (!spec) return std::unexpected(spec.error());

  LoadedCells out{.typed = path_or_name, .spec = std::move(*spec), .cells = {}, .input = {}, .digest = {}};
  const std::string& named = out.spec.scene.value;
  auto scene = load_scene(is_path(named) ? beside(path_or_name, named) : named);
  if (!scene) return std::unexpected(one(out.spec.scene.place, to_text(scene.error())));
  if (scene->masters() == 0)
    return std::unexpected(one(out.spec.scene.place, "has no MASTER seat whose device could be used"));
  out.input.scene = std::move(*scene);

  transport::Digest digest;
  digest.add(text->first);
  digest.add(effective_scene_text(out.input.scene));
  if (!out.spec.recording.value.empty()) {
    auto options = hal::sim::parse_motion_options(out.spec.recording.value);
    if (!options) return std::unexpected(one(out.spec.recording.place, options.error()));
    options->file = beside(path_or_name, options->file);
    auto motion = hal::load_motion(*options);
    if (!motion) return std::unexpected(one(out.spec.recording.place, motion.error()));
    out.input.recording = std::move(*motion);
    if (std::string problem = add_file(options->file, digest); !problem.empty())
      return std::unexpected(one(out.spec.recording.place, std::move(problem)));
  }
  if (InputErrors problems = cell_problems(out.spec, out.input.scene); !problems.empty())
    return std::unexpected(std::move(problems));
  out.digest = digest.hex().substr(0, kDigits);
  out.cells = cells_of(out.spec);
  return out;
}

std::expected<std::string, std::string> program_digest() {
  transport::Digest digest;
  if (std::string problem = add_file("/proc/self/exe", digest); !problem.empty())
    return std::unexpected(std::move(problem));
  return digest.hex().substr(0, kDigits);
}

}  // namespace tandem::netsim
