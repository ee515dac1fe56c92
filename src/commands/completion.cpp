#include <CLI/CLI.hpp>
#include <memory>

#include "commands/command.h"
#include "commands/completions.h"
#include "commands/usage.h"

namespace gramloom {

namespace {

// Each asks the program itself what fits: no shell has a list of its own. A word that ends with =
// or / is not finished.

constexpr const char* bash_script = R"(# Completion of gramloom for bash.
_gramloom() {
  local line=${COMP_LINE:0:COMP_POINT} words
  read -ra words <<<"$line"
  [[ $line == *[[:space:]] ]] && words+=("")
  local word=${words[-1]} candidate
  # Readline replaces what stands behind the last = or : alone.
  local kept=${word%"${word##*[=:]}"}
  COMPREPLY=()
  while IFS=$'\t' read -r candidate _; do
    COMPREPLY+=("${candidate#"$kept"}")
    [[ $candidate == *[=/] ]] && compopt -o nospace 2>/dev/null
  done < <("${COMP_WORDS[0]}" completion words -- "${words[@]:1}" 2>/dev/null)
}
complete -o default -F _gramloom gramloom
)";

constexpr const char* zsh_script = R"(#compdef gramloom
# Completion of gramloom for zsh.
_gramloom() {
  local line
  local -a finished finished_shown open open_shown
  while IFS= read -r line; do
    if [[ ${line%%$'\t'*} == *[=/] ]]; then
      open+=("${line%%$'\t'*}")
      open_shown+=("${line/$'\t'/  }")
    else
      finished+=("${line%%$'\t'*}")
      finished_shown+=("${line/$'\t'/  }")
    fi
  done < <("${words[1]}" completion words -- "${(@)words[2,CURRENT]}" 2>/dev/null)
  if (( $#finished + $#open == 0 )); then
    _files
    return
  fi
  (( $#finished )) && compadd -l -d finished_shown -a finished
  (( $#open )) && compadd -l -S '' -d open_shown -a open
}
if [[ $funcstack[1] == _gramloom ]]; then
  _gramloom "$@"
else
  compdef _gramloom gramloom
fi
)";

constexpr const char* fish_script = R"(# Completion of gramloom for fish.
function __gramloom_words
    set -l before (commandline -opc)
    set -l word (commandline -ct)
    set -l candidates ($before[1] completion words -- $before[2..-1] "$word" 2>/dev/null)
    if set -q candidates[1]
        printf '%s\n' $candidates
    else
        __fish_complete_path "$word"
    end
end
complete -c gramloom -f -a '(__gramloom_words)'
)";

ExitCode print_candidates(const CLI::App& program, const std::vector<std::string>& words) {
  std::string text;
  for (const Candidate& candidate : completions_of(program, words))
    text += candidate.meaning.empty() ? candidate.word + "\n"
                                      : fmt::format("{}\t{}\n", candidate.word, candidate.meaning);
  return print(text);
}

struct CompletionArguments {
  std::string shell;
  std::vector<std::string> words;
};

ExitCode completion(const CLI::App& program, const CompletionArguments& arguments) {
  if (arguments.shell == "bash") return print(bash_script);
  if (arguments.shell == "zsh") return print(zsh_script);
  if (arguments.shell == "fish") return print(fish_script);
  return print_candidates(program, arguments.words);
}

}  // namespace

Command add_completion(CLI::App& program) {
  const auto arguments = std::make_shared<CompletionArguments>();
  CLI::App* command = program.add_subcommand(
      "completion",
      "Print what lets a shell complete commands of gramloom: source <(gramloom "
      "completion bash)");
  command
      ->add_option("shell", arguments->shell,
                   "which; words: what they ask, a line for each word that may be next")
      ->required()
      ->check(one_of({"bash", "zsh", "fish", "words"}));
  command->add_option("words", arguments->words,
                      "of the command line so far, without 'gramloom', the last to be completed");
  return {command, [&program, arguments] { return completion(program, *arguments); }};
}

}  // namespace gramloom
