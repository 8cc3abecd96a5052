// Requests about recordings: their exact form, and the roles that may send them.
#include "server/console/recording_request.h"

#include <gtest/gtest.h>

#include "common/base/rng.h"

namespace tandem::console {
namespace {

using What = RecordingRequest::What;
const std::string kId = "0123456789abcdef0123456789abcdef";

TEST(RecordingRequests, HaveFourForms) {
  EXPECT_EQ(parse_recording_request("/recordings"), RecordingRequest{});
  EXPECT_EQ(parse_recording_request("/recordings/" + kId), (RecordingRequest{What::kOutline, kId, 0}));
  EXPECT_EQ(parse_recording_request("/recordings/" + kId + "/scores"), (RecordingRequest{What::kScores, kId, 0}));
  EXPECT_EQ(parse_recording_request("/recordings/" + kId + "/pieces/0"), (RecordingRequest{What::kPiece, kId, 0}));
  EXPECT_EQ(parse_recording_request("/recordings/" + kId + "/pieces/9999999"),
            (RecordingRequest{What::kPiece, kId, 9'999'999}));
}

// An id has hex digits only, so that no request has a path, whatever a browser or proxy makes of dots and escapes.
TEST(RecordingRequests, RefuseEveryPathAndEveryOtherForm) {
  for (const std::string& tail : {std::string("/"),
                                  std::string("/../x"),
                                  std::string("/%2e%2e/x"),
                                  "/" + kId + "/",
                                  "/" + kId + "/..",
                                  "/" + kId + "/pieces",
                                  "/" + kId + "/pieces/",
                                  "/" + kId + "/pieces/-1",
                                  "/" + kId + "/pieces/01",
                                  "/" + kId + "/pieces/1/",
                                  "/" + kId + "/pieces/10000000",
                                  "/" + kId + "/pieces/99999999999999999999",
                                  "/" + kId + "/pieces/1e3",
                                  "/" + kId + "/scores/",
                                  "/" + kId + "?x",
                                  "/" + kId.substr(1),
                                  "/" + kId + "0",
                                  "/" + std::string(32, 'A'),
                                  "/" + std::string(32, '.'),
                                  "/" + std::string(32, '/'),
                                  std::string("x"),
                                  "/" + std::string(31, '0') + std::string(1, '\0')})
    EXPECT_FALSE(parse_recording_request("/recordings" + tail)) << tail;
  for (const char* other : {"", "/", "/recording", "/RECORDINGS", "recordings", "//recordings"})
    EXPECT_FALSE(parse_recording_request(other)) << other;
}

TEST(RecordingRequests, SurviveAnyBytes) {
  RandomStream random{1};
  const std::string valid = "/recordings/" + kId + "/pieces/123";
  for (int i = 0; i < 20'000; ++i) {
    std::string text = valid.substr(0, random.below(valid.size() + 1));
    for (std::uint64_t n = random.below(4); n > 0 && !text.empty(); --n)
      text[random.below(text.size())] = static_cast<char>(random.bits());
    const auto request = parse_recording_request(text);
    if (!request) continue;
    EXPECT_TRUE(request->id.empty() || request->id.size() == RecordingRequest::kIdLength);
    EXPECT_EQ(request->id.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

TEST(RecordingRequests, AreForRolesThatScoreOnly) {
  EXPECT_TRUE(may_review(AccessRole::kInstructor));
  EXPECT_TRUE(may_review(AccessRole::kEvaluator));
  EXPECT_TRUE(may_review(AccessRole::kOperator));
  EXPECT_FALSE(may_review(AccessRole::kTrainee));
  EXPECT_FALSE(may_review(AccessRole::kObserver));
  EXPECT_FALSE(may_review(AccessRole::kRecorder));
  EXPECT_FALSE(may_review(static_cast<AccessRole>(99)));
}

}  // namespace
}  // namespace tandem::console
