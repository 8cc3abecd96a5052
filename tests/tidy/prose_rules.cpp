#include "tests/tidy/prose_rules.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace tandem::tidy {
namespace {

constexpr std::string_view kActor = "name the actor: client, server, seat, session, participant, operator";
constexpr std::string_view kRestart = "again, restart";
constexpr std::string_view kReport = "the named subject reports, logs, returns or receives";
constexpr std::string_view kGender = "the named subject, or \"they\"";
constexpr std::string_view kRelease = "release, disengage";

constexpr std::array kPhrases{
    BannedPhrase{"anew", kRestart},
    BannedPhrase{"by and by", "gradually, with the duration"},
    BannedPhrase{"on the spot", "ephemeral, at once"},
    BannedPhrase{"is told", kReport},
    BannedPhrase{"are told", kReport},
    BannedPhrase{"was told", kReport},
    BannedPhrase{"were told", kReport},
    BannedPhrase{"be told", kReport},
    BannedPhrase{"goes without", "sheds, omits"},
    BannedPhrase{"go without", "shed, omit"},
    BannedPhrase{"lays down", "publishes, writes"},
    BannedPhrase{"lay down", "publish, write"},
    BannedPhrase{"laid down", "published, written"},
    BannedPhrase{"whoever", kActor},
    BannedPhrase{"whomever", kActor},
    BannedPhrase{"nobody", kActor},
    BannedPhrase{"somebody", kActor},
    BannedPhrase{"everybody", kActor},
    BannedPhrase{"anybody", kActor},
    BannedPhrase{"he", kGender},
    BannedPhrase{"him", kGender},
    BannedPhrase{"his", kGender},
    BannedPhrase{"himself", kGender},
    BannedPhrase{"she", kGender},
    BannedPhrase{"her", kGender},
    BannedPhrase{"hers", kGender},
    BannedPhrase{"herself", kGender},
    BannedPhrase{"lets go", kRelease},
    BannedPhrase{"let go", kRelease},
    BannedPhrase{"letting go", kRelease},
    BannedPhrase{"goes home", "decays, returns"},
    BannedPhrase{"go home", "decay, return"},
    BannedPhrase{"walks home", "decays, returns"},
    BannedPhrase{"sent away", "removed"},
    BannedPhrase{"sends away", "removes"},
    BannedPhrase{"looks after", "operates, monitors"},
    BannedPhrase{"look after", "operate, monitor"},
    BannedPhrase{"newcomer", "new participant, new contributor"},
    BannedPhrase{"newcomers", "new participants"},
    BannedPhrase{"says goodbye", "ends cleanly"},
    BannedPhrase{"deadman", "watchdog"},
};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; }
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Returns the comments of scripts, schemas and CMake files: from `#` or `//` to the end of the line.
std::string comments_of(std::string_view text, std::string_view mark) {
  std::string prose(text);
  bool comment = false;
  for (std::size_t i = 0; i < prose.size(); ++i) {
    if (prose[i] == '\n') {
      comment = false;
    } else if (!comment && text.substr(i).starts_with(mark)) {
      comment = true;
    } else if (!comment) {
      prose[i] = ' ';
    }
  }
  return prose;
}

/// Copies the names of tests from the code into `prose`; words_of() splits them at their capitals.
void show_test_names(const SourceFile& file, std::string& prose) {
  for (const std::string_view macro : {"TEST(", "TEST_F(", "TEST_P(", "TYPED_TEST("}) {
    for (std::size_t at = file.code.find(macro); at != std::string::npos; at = file.code.find(macro, at + 1)) {
      if (at > 0 && is_word(file.code[at - 1])) continue;
      const std::size_t begin = at + macro.size();
      const std::size_t end = std::min(file.code.find(')', begin), file.code.size());
      for (std::size_t i = begin; i < end; ++i) prose[i] = file.code[i];
    }
  }
}

/// One word of the prose in lower case, with its position and its relation to the text before it.
struct Word {
  std::string text;
  std::size_t at = 0;
  bool begins_sentence = false;
  bool joined = false;  ///< only blanks, and at most the comment mark of a line, separate it from the previous word
};

std::vector<Word> words_of(std::string_view prose) {
  std::vector<Word> words;
  bool sentence = true;
  bool joined = false;
  std::size_t line = 1;
  std::size_t comment_line = 0;  // line of the last line comment
  std::size_t i = 0;
  while (i < prose.size()) {
    const char c = prose[i];
    if (c == '\n') ++line;
    if (prose.substr(i).starts_with("//")) {  // a comment continues that of the line above, unless it is a member's own
      if (line > comment_line + 1 || prose.substr(i).starts_with("///<")) sentence = true;
      comment_line = line;
      while (i < prose.size() && prose[i] == '/') ++i;
      continue;
    }
    if (!is_letter(c)) {
      if (c == '.' || c == '!' || c == '?' || c == ':' || c == ';' || c == '(' || c == '|' || c == '"') sentence = true;
      if (c != ' ' && c != '\n' && c != '#' && c != '\t') joined = false;
      ++i;
      continue;
    }
    // A word in CamelCase counts as its parts. A word with digits or '_' is a name and counts whole.
    std::size_t end = i;
    while (end < prose.size() && is_word(prose[end])) ++end;
    const std::string_view whole = prose.substr(i, end - i);
    const bool name = std::ranges::any_of(whole, [](char w) { return w == '_' || (w >= '0' && w <= '9'); });
    std::size_t begin = i;
    while (begin < end) {
      std::size_t next = begin + 1;
      while (next < end && (name || std::isupper(static_cast<unsigned char>(prose[next])) == 0)) ++next;
      Word word;
      for (const char w : prose.substr(begin, next - begin)) word.text += lower(w);
      word.at = begin;
      word.begins_sentence = sentence && begin == i;
      word.joined = joined;
      words.push_back(std::move(word));
      sentence = false;
      joined = true;
      begin = next;
    }
    i = end;
  }
  return words;
}

std::vector<std::string_view> split(std::string_view phrase) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= phrase.size();) {
    const std::size_t space = std::min(phrase.find(' ', at), phrase.size());
    parts.push_back(phrase.substr(at, space - at));
    at = space + 1;
  }
  return parts;
}

bool matches(const std::vector<Word>& words, std::size_t first, const std::vector<std::string_view>& parts) {
  if (first + parts.size() > words.size()) return false;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (words[first + k].text != parts[k] || (k > 0 && !words[first + k].joined)) return false;
  }
  return true;
}

/// Returns whether the word is a whole string literal: a key of JSON.
bool is_key(std::string_view prose, const Word& word) {
  const std::size_t end = word.at + word.text.size();
  return word.at > 0 && prose[word.at - 1] == '"' && end < prose.size() && prose[end] == '"';
}

/// Returns whether the sentence that begins at `at` ends with a question mark.
bool is_question(std::string_view prose, std::size_t at) {
  const std::size_t end = prose.find_first_of(".?!|", at);
  return end != std::string_view::npos && prose[end] == '?';
}

}  // namespace

std::span<const BannedPhrase> banned_phrases() { return kPhrases; }

std::string prose_of(const SourceFile& file) {
  if (file.path.ends_with(".md")) return file.text;
  if (file.path.ends_with(".proto")) return comments_of(file.text, "//");
  if (!is_cpp(file.path)) return comments_of(file.text, "#");
  std::string prose = file.text;
  for (std::size_t i = 0; i < prose.size(); ++i) {
    if (prose[i] != '\n' && file.code[i] == file.text[i]) prose[i] = file.code[i] == '"' ? '"' : ' ';
  }
  show_test_names(file, prose);
  return prose;
}

std::vector<Finding> check_prose(const SourceFile& file) {
  static const auto phrases = [] {
    std::vector<std::vector<std::string_view>> all;
    for (const BannedPhrase& banned : kPhrases) all.push_back(split(banned.phrase));
    return all;
  }();
  const std::string prose = prose_of(file);
  const std::vector<Word> words = words_of(prose);
  std::vector<Finding> findings;
  std::size_t line = 1;
  std::size_t counted = 0;
  for (std::size_t w = 0; w < words.size(); ++w) {
    const auto report = [&](std::string_view found, std::string_view instead) {
      line += static_cast<std::size_t>(std::count(prose.begin() + static_cast<std::ptrdiff_t>(counted),
                                                  prose.begin() + static_cast<std::ptrdiff_t>(words[w].at), '\n'));
      counted = words[w].at;
      findings.push_back({file.path, line, "\"" + std::string(found) + "\": " + std::string(instead)});
    };
    for (std::size_t p = 0; p < phrases.size(); ++p) {
      if (matches(words, w, phrases[p])) report(kPhrases[p].phrase, kPhrases[p].instead);
    }
    if (words[w].begins_sentence && (words[w].text == "who" || words[w].text == "what") &&
        !is_question(prose, words[w].at) && !is_key(prose, words[w])) {
      report("a sentence that begins with " + words[w].text, kActor);
    }
  }
  return findings;
}

}  // namespace tandem::tidy
