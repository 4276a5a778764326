//! `povr completions`: shell scripts that complete command lines, POV-Ray's switches included.

use crate::app::cli::options::command_line;
use std::process::ExitCode;

use clap::Parser;
use clap_complete::Shell;

use super::Command;
use super::draw::report::say;
use super::man::put;
use super::options::environment::Environment;
use super::options::error::CliError;
use super::options::long_options;
use super::options::switches;

pub(super) const COMMAND: Command = Command {
    name: "completions",
    about: "print what a shell needs to complete command lines",
    run,
    options: <CommandOptions as clap::CommandFactory>::command,
};

/// Prints what a shell needs to complete command lines of povr.
#[derive(Debug, Parser)]
#[command(
    name = "povr completions",
    after_help = "\
bash: povr completions bash > ~/.local/share/bash-completion/completions/povr
zsh:  povr completions zsh > a folder of $fpath, as _povr
fish: povr completions fish > ~/.config/fish/completions/povr.fish"
)]
struct CommandOptions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

fn run(arguments: &[String], _: &Environment) -> Result<ExitCode, CliError> {
    let name = std::iter::once("povr completions".to_owned());
    match CommandOptions::try_parse_from(name.chain(arguments.iter().cloned())) {
        Ok(options) => put(&script(options.shell)),
        Err(error) => say(command_line::printed::<CommandOptions>(&error)?.trim_end()),
    }
    Ok(ExitCode::SUCCESS)
}

/// The script: clap's, followed by POV-Ray's switches, which clap does not know.
fn script(shell: Shell) -> String {
    let mut bytes = Vec::new();
    clap_complete::generate(shell, &mut long_options::everything(), "povr", &mut bytes);
    let mut script = String::from_utf8_lossy(&bytes).into_owned();
    let names: Vec<String> = switches::described().map(|one| one.name).collect();
    match shell {
        Shell::Bash => {
            script += &format!(
                "\n_povr_and_switches() {{\n    local word=\"${{COMP_WORDS[COMP_CWORD]}}\"\n    \
                 if [[ $word == +* ]]; then\n        compopt -o nospace\n        \
                 COMPREPLY=( $(compgen -W \"{}\" -- \"${{word^^}}\") )\n    else\n        _povr \"$@\"\n    fi\n}}\n\
                 complete -F _povr_and_switches -o bashdefault -o default povr\n",
                names.join(" ")
            );
        }
        Shell::Fish => {
            for one in switches::described() {
                let about = one.sets.replace('\'', "\\'");
                script += &format!("complete -c povr -a '{}' -d '{about}'\n", one.name);
            }
        }
        Shell::Zsh => {
            let called = "_povr \"$@\"";
            let described: Vec<String> = switches::described()
                .map(|one| format!("'{}:{}'", one.name, one.sets.replace(':', "\\:")))
                .collect();
            let own = format!(
                "if [[ $PREFIX == +* ]]; then\n    local -a switches=({})\n    _describe 'switch' switches -S ''\nelse\n    \
                 {called}\nfi",
                described.join(" ")
            );
            script = script.replacen(called, &own, 1);
        }
        _ => {}
    }
    script
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum;

    #[test]
    fn every_shell_gets_every_option_and_command() {
        for &shell in Shell::value_variants() {
            let script = script(shell);
            for word in [
                "message-format",
                "compare",
                "hardfail",
                "completions",
                "pov-distances",
                "pov-random",
            ] {
                assert!(script.contains(word), "{shell}: {word}");
            }
        }
    }

    #[test]
    fn switches_of_povray_are_completed() {
        for shell in [Shell::Bash, Shell::Fish, Shell::Zsh] {
            let script = script(shell);
            for one in switches::described() {
                assert!(script.contains(&one.name), "{shell}: {}", one.name);
            }
        }
    }
}
