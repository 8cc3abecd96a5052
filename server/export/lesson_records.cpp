#include "server/export/lesson_records.h"

#include "common/base/format.h"

namespace tandem::server {

namespace {

/// Collects the first column of a wrong length.
class ColumnCheck {
 public:
  explicit ColumnCheck(std::size_t rows) : rows_(rows) {}

  template <class Value>
  void column(const std::string& of, const char* name, const std::vector<Value>& values) {
    if (values.size() == rows_ || !problem_.empty()) return;
    problem_ =
        format("column %s of %s has %zu values, the lesson has %zu rows", name, of.c_str(), values.size(), rows_);
  }
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  std::size_t rows_;
  std::string problem_;
};

void check_seat(ColumnCheck& check, const std::string& name, const LessonSeat& s) {
  const std::string of = "seat " + name;
  check.column(of, "fresh", s.fresh);
  check.column(of, "sample_tick", s.sample_tick);
  check.column(of, "q", s.q);
  check.column(of, "x", s.x);
  check.column(of, "v", s.v);
  check.column(of, "f", s.f);
  check.column(of, "f_cmd", s.f_cmd);
  check.column(of, "alpha", s.alpha);
  check.column(of, "engaged", s.engaged);
  check.column(of, "gate", s.gate);
  check.column(of, "leader", s.leader);
  check.column(of, "ghost", s.ghost);
  check.column(of, "e_in", s.e_in);
  check.column(of, "e_out", s.e_out);
  check.column(of, "dissipated_j", s.dissipated_j);
  check.column(of, "refused_j", s.refused_j);
  check.column(of, "margin_min_j", s.margin_min_j);
  check.column(of, "delivered_j", s.delivered_j);
}

void check_tool(ColumnCheck& check, const std::string& name, const LessonTool& t) {
  const std::string of = "tool " + name;
  check.column(of, "q", t.q);
  check.column(of, "x", t.x);
  check.column(of, "x_tool", t.x_tool);
  check.column(of, "f_cmd", t.f_cmd);
  check.column(of, "f_env", t.f_env);
  check.column(of, "penetration", t.penetration);
  check.column(of, "held", t.held);
  check.column(of, "alpha", t.alpha);
  check.column(of, "mfs_j", t.mfs_j);
  check.column(of, "e_p_j", t.e_p_j);
  check.column(of, "e_p_axis_j", t.e_p_axis_j);
  check.column(of, "sample_tick", t.sample_tick);
}

}  // namespace

std::string lesson_problem(const Lesson& lesson) {
  const SceneSpec& scene = lesson.scene;
  if (scene.seats.empty() || scene.tools.empty()) return "its scene has no seat or no tool";
  if (scene.seats.size() > kSeatsMax || scene.tools.size() > kToolsMax) return "its scene has too many seats or tools";
  if (lesson.seats.size() != scene.seats.size() || lesson.tools.size() != scene.tools.size())
    return format("it has %zu seats and %zu tools, its scene %zu and %zu", lesson.seats.size(), lesson.tools.size(),
                  scene.seats.size(), scene.tools.size());
  if (lesson.rows() == 0) return "it has no row: no tick of the session was recorded";
  ColumnCheck check(lesson.rows());
  check.column("the session", "time_ns", lesson.time_ns);
  check.column("the session", "running", lesson.running);
  check.column("the session", "stopped_ticks", lesson.stopped_ticks);
  check.column("the session", "dropped_ticks", lesson.dropped_ticks);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) check_seat(check, scene.seats[i].name, lesson.seats[i]);
  for (std::size_t j = 0; j < lesson.tools.size(); ++j) check_tool(check, scene.tools[j].name, lesson.tools[j]);
  if (!check.problem().empty()) return check.problem();
  for (std::size_t k = 1; k < lesson.rows(); ++k)
    if (lesson.tick[k] <= lesson.tick[k - 1])
      return format("row %zu has session tick %u after %u: ticks must increase", k, lesson.tick[k], lesson.tick[k - 1]);
  return {};
}

void GapFinder::add(const Lesson& rows) {
  for (const std::uint32_t tick : rows.tick) {
    if (last_ && tick - *last_ > 1) gaps_.push_back({*last_ + 1, tick - *last_ - 1});
    last_ = tick;
  }
}

std::vector<LessonGap> gaps_of(const Lesson& lesson) {
  GapFinder finder;
  finder.add(lesson);
  return finder.gaps();
}

std::size_t joints_of(const SceneSpec& scene) {
  return scene.seats.front().device.model == DeviceModel::kLinear ? 1 : 3;
}

}  // namespace tandem::server
