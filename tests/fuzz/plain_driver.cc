// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Runs a fuzz target without libFuzzer, so that every build tests what fuzzing has found:
//
//   fuzz_TARGET INPUT...                         runs these inputs
//   fuzz_TARGET --mutations N TOKENS FOLDER      runs all inputs of a folder, then N mutations of
//   them
//
// Mutations are drawn from a fixed seed. TOKENS is a dictionary in the syntax of libFuzzer. An
// input that crashes is written to crash-TARGET in the working directory.

#include <algorithm>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <random>
#include <vector>

#include "tests/fuzz/fuzz_target.h"
#include <fcntl.h>
#include <unistd.h>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

constexpr size_t kMaxBytes = 4096;            // of a mutated input
constexpr unsigned kMaxSecondsPerInput = 10;  // an input that takes longer hangs

std::string crash_file;
std::string current_input;

// Writes the current input. Calls only functions that are allowed in a signal handler.
void KeepInput(int signal) {
  const int file = open(crash_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file >= 0 && write(file, current_input.data(), current_input.size()) >= 0) {
    constexpr char kMessage[] = "\nthe input that crashes or hangs is in the file ";
    if (write(STDERR_FILENO, kMessage, sizeof(kMessage) - 1) < 0 ||
        write(STDERR_FILENO, crash_file.data(), crash_file.size()) < 0 ||
        write(STDERR_FILENO, "\n", 1) < 0) {
      _exit(1);
    }
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void Run(const std::string& input) {
  current_input = input;
  alarm(kMaxSecondsPerInput);
  // A copy of exactly this size, so that a tool for memory errors sees every read beyond its end.
  const std::vector<uint8_t> bytes(input.begin(), input.end());
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  alarm(0);
}

// Decodes \\, \" and \xHH between the quotes of a line of the dictionary.
std::string Unquoted(const std::string& line) {
  std::string token;
  const size_t end = line.rfind('"');
  for (size_t i = line.find('"') + 1; i < end; ++i) {
    if (line[i] != '\\') {
      token += line[i];
    } else if (line[++i] == 'x') {
      token += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      token += line[i];
    }
  }
  return token;
}

std::vector<std::string> ReadTokens(const std::string& path) {
  std::vector<std::string> tokens;
  std::string content = ReadFile(path);
  for (size_t end = content.find('\n'); end != std::string::npos; end = content.find('\n')) {
    const std::string line = content.substr(0, end);
    if (!line.empty() && line[0] == '"') tokens.push_back(Unquoted(line));
    content.erase(0, end + 1);
  }
  return tokens;
}

// Makes new inputs from the seeds.
class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, std::vector<std::string> tokens)
      : seeds_(std::move(seeds)), tokens_(std::move(tokens)) {}

  std::string Next() {
    std::string input = seeds_[Below(seeds_.size())];
    for (size_t i = 1 + Below(6); i > 0; --i) Mutate(&input);
    input.resize(std::min(input.size(), kMaxBytes));
    return input;
  }

 private:
  size_t Below(size_t count) { return count == 0 ? 0 : random_() % count; }

  void Mutate(std::string* input) {
    const size_t at = Below(input->size() + 1);
    const size_t length = Below(std::min<size_t>(input->size() - at, 64) + 1);
    const std::string& other = seeds_[Below(seeds_.size())];
    const size_t from = Below(other.size() + 1);
    switch (Below(9)) {
      case 0:
        if (at < input->size()) (*input)[at] = static_cast<char>((*input)[at] ^ (1 << Below(8)));
        break;
      case 1:
        if (at < input->size()) (*input)[at] = static_cast<char>(random_());
        break;
      case 2:
        input->erase(at, length);
        break;
      case 3:
        input->insert(at, input->substr(at, length));
        break;
      case 4:
        input->resize(at);
        break;
      case 5:
        input->insert(at, other.substr(from, 1 + Below(64)));
        break;
      case 6:
        input->replace(at, length, other.substr(from, 1 + Below(64)));
        break;
      case 7:
        input->insert(at, tokens_[Below(tokens_.size())]);
        break;
      default:
        ReplaceWord(at, input);
    }
  }

  // Puts a token in the place of the word at a position.
  void ReplaceWord(size_t at, std::string* input) {
    constexpr char kEnds[] = " \t\r\n,:=[]{}";
    const size_t before = at == 0 ? std::string::npos : input->find_last_of(kEnds, at - 1);
    const size_t begin = before == std::string::npos ? 0 : before + 1;
    const size_t end = std::min(input->find_first_of(kEnds, at), input->size());
    input->replace(begin, end - begin, tokens_[Below(tokens_.size())]);
  }

  std::vector<std::string> seeds_;
  std::vector<std::string> tokens_;
  std::mt19937_64 random_{1};
};

// Runs all seeds. A seed must be accepted, unless its name says that it is refused or was found by
// fuzzing: a seed that a changed reader refuses tests nothing any more.
std::vector<std::string> RunSeeds(const std::string& folder) {
  std::vector<std::string> paths = ListFolder(folder);
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> seeds;
  for (const std::string& path : paths) {
    const std::string name = std::filesystem::path(path).filename().string();
    seeds.push_back(ReadFile(path));
    const int64_t before = num_accepted;
    Run(seeds.back());
    const bool may_be_refused = name.rfind("refused", 0) == 0 || name.rfind("found", 0) == 0;
    Require(may_be_refused || num_accepted > before, "the seed " + path + " is accepted");
  }
  Require(!seeds.empty(), "there are seeds in " + folder);
  return seeds;
}

int RunDriver(const std::vector<std::string>& arguments) {
  crash_file = "crash-" + std::filesystem::path(arguments[0]).filename().string();
  for (const int signal : {SIGABRT, SIGALRM, SIGBUS, SIGFPE, SIGILL, SIGSEGV}) {
    std::signal(signal, KeepInput);
  }
  if (arguments.size() != 5 || arguments[1] != "--mutations") {
    for (size_t i = 1; i < arguments.size(); ++i) Run(ReadFile(arguments[i]));
    std::cout << arguments.size() - 1 << " inputs without a finding\n";
    return 0;
  }
  const int num_mutations = std::stoi(arguments[2]);
  const std::vector<std::string> seeds = RunSeeds(arguments[4]);
  const int64_t accepted_seeds = num_accepted;
  Mutator mutator(seeds, ReadTokens(arguments[3]));
  for (int i = 0; i < num_mutations; ++i) Run(mutator.Next());
  std::cout << seeds.size() << " seeds and " << num_mutations << " mutations without a finding; "
            << accepted_seeds << " and " << num_accepted - accepted_seeds << " accepted\n";
  return 0;
}

}  // namespace
}  // namespace msc_vo

int main(int argc, char** argv) { return msc_vo::RunDriver({argv, argv + argc}); }
