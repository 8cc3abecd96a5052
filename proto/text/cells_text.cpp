#include "proto/text/cells_text.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>

#include "proto/schema/cells.pb.h"
#include "proto/schema/limits.pb.h"
#include "proto/text/text_format_reader.h"

namespace tandem {
namespace {

using text::child_path;
using text::MessageValidator;

static_assert(static_cast<int>(CellTask::kRecorded) == pb::CellGrid::RECORDED);
static_assert(kCellTaskNames.size() == pb::CellGrid::Task_ARRAYSIZE);
static_assert(static_cast<int>(CellAlpha::kStepped) == pb::CellGrid::STEPPED);
static_assert(kCellAlphaNames.size() == pb::CellGrid::Alpha_ARRAYSIZE);

/// Reads the grids of one file.
class GridReader {
 public:
  GridReader(MessageValidator& validator, std::string_view file) : validator_(validator), file_(file) {}

  [[nodiscard]] InputError place(const std::string& key) const {
    const text::SourceLocation at = validator_.location(key);
    return {std::string(file_), at.line, at.column, key, at.value, ""};
  }

  [[nodiscard]] CellGridSpec read(const pb::CellGrid& in, const std::string& key) {
    CellGridSpec out;
    out.name = in.name();
    out.laws = axis<LawKind>(in.law(), key, "law");
    out.couplings = axis<HandCouplingKind>(in.coupling(), key, "coupling", HandCouplingKind::kEsc);
    out.hands = axis<std::uint32_t>(in.hands(), key, "hands", 2);
    out.delays_ms = axis<double>(in.delay_ms(), key, "delay_ms", 0);
    out.jitters_ms = axis<double>(in.jitter_ms(), key, "jitter_ms", 0);
    out.losses_percent = axis<double>(in.loss_percent(), key, "loss_percent", 0);
    out.outages_ms = axis<double>(in.outage_ms(), key, "outage_ms", 0);
    out.tasks = axis<CellTask>(in.task(), key, "task");
    out.alphas = axis<CellAlpha>(in.alpha(), key, "alpha", CellAlpha::kOne);
    return out;
  }

 private:
  /// Reads the values of an axis; reports values that occur twice.
  template <class Value>
  [[nodiscard]] CellAxis<Value> axis(const auto& values, const std::string& grid, std::string_view field) {
    CellAxis<Value> out;
    for (int i = 0; i < values.size(); ++i) {
      const std::string key = child_path(grid, field, i);
      const auto value = static_cast<Value>(values[i]);
      if (std::ranges::any_of(out, [&](const auto& earlier) { return earlier.value == value; }))
        validator_.error(key, "is there twice; every value of an axis occurs once");
      out.push_back({value, place(key)});
    }
    if (out.empty() && !validator_.is_set(child_path(grid, field)) && !validator_.is_set(child_path(grid, field, 0)) &&
        (field == "law" || field == "task"))
      validator_.error(grid, "needs " + std::string(field) + ", such as " +
                                 (field == "law" ? "law: [REPLICA, SET_POSITION]" : "task: [FREE, WALL]"));
    return out;
  }
  /// The same with the value of an absent axis.
  template <class Value>
  [[nodiscard]] CellAxis<Value> axis(const auto& values, const std::string& grid, std::string_view field,
                                     Value absent) {
    CellAxis<Value> out = axis<Value>(values, grid, field);
    if (out.empty()) out.push_back({absent, place(grid)});
    return out;
  }

  MessageValidator& validator_;
  std::string_view file_;
};

std::string stem_of(std::string_view file) {
  if (const auto slash = file.rfind('/'); slash != std::string_view::npos) file.remove_prefix(slash + 1);
  return std::string(file.substr(0, file.find('.')));
}

}  // namespace

std::expected<CellsSpec, InputErrors> parse_cells_text(std::string_view text, std::string_view file_name) {
  MessageValidator validator{file_name};
  pb::Cells in;
  if (!text::read_document(text, file_name, in, validator)) return std::unexpected(validator.take());

  GridReader reader{validator, file_name};
  CellsSpec out;
  out.name = stem_of(file_name);
  out.summary = in.summary();
  out.scene = {in.scene(), reader.place("scene")};
  if (in.has_scene() && in.scene().empty()) validator.error("scene", "is empty; name a shipped scene or a file");
  out.recording = {in.recording(), reader.place("recording")};
  if (in.has_recording() && in.recording().empty()) validator.error("recording", "is empty; name a .csv file");
  if (in.has_seed()) out.seed = in.seed();
  if (in.has_seeds()) out.seeds = in.seeds();
  if (in.grid_size() == 0) validator.error("grid", "is missing; a file needs at least one grid { }");
  for (int i = 0; i < in.grid_size(); ++i) {
    const std::string key = child_path("", "grid", i);
    CellGridSpec grid = reader.read(in.grid(i), key);
    if (std::ranges::any_of(out.grids, [&](const auto& earlier) { return earlier.name == grid.name; }))
      validator.error(child_path(key, "name"), "is the name of an earlier grid; every grid needs a name of its own");
    if (in.recording().empty() &&
        std::ranges::any_of(grid.tasks, [](const auto& task) { return task.value == CellTask::kRecorded; }))
      validator.error(child_path(key, "task"), "RECORDED needs the key recording: \"FILE.csv\" of the file");
    out.grids.push_back(std::move(grid));
  }
  if (out.cells() > kCellsMax)
    validator.error("grid", "the grids have " + text::number_text(static_cast<double>(out.cells())) +
                                " cells together; at most " + text::number_text(kCellsMax) + " are allowed");
  if (!validator.ok()) return std::unexpected(validator.take());
  return out;
}

}  // namespace tandem
