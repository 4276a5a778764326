//! Settings from outside the command line: POV-Ray's ini files of the system and of the user.

use std::env;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use super::conf::Conf;
use super::error::CliError;
use super::ini::Reader;
use super::raw_args::RawArgs;
use crate::app::cli::options::output_kinds::MessageFormat;

/// Settings from outside the command line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Environment {
    /// The system's ini file, that of POV-Ray 3.8 where 3.7 is not installed. Only its library paths are used; display
    /// and verbosity are ignored.
    pub system_ini: Option<PathBuf>,
    /// The user's ini file.
    pub user_ini: Option<PathBuf>,
    /// A warning about it.
    pub warning: Option<String>,
    /// The files `povray.conf`.
    pub conf: Conf,
    /// True if standard error is a terminal, where people read.
    pub is_terminal: bool,
    /// True if the program was called by the name `povray`.
    pub is_povray: bool,
}

impl Environment {
    /// The environment of this process. Ini files are searched as in POV-Ray: `$POVINI`, `povray.ini` here, in
    /// `~/.povray/3.7`, in `/etc`.
    #[must_use]
    pub fn of_this_process() -> Self {
        Environment::with_ini_files(&[Path::new("povray.ini")])
    }

    /// The same without `povray.ini` in the current folder, which may come with scenes of strangers.
    #[must_use]
    pub(crate) fn outside_of_this_folder() -> Self {
        Environment::with_ini_files(&[])
    }

    fn with_ini_files(near: &[&Path]) -> Self {
        let named = env::var_os("POVINI").map(PathBuf::from);
        let missing = named.as_ref().filter(|file| !file.is_file());
        let home = env::var_os("HOME").map(PathBuf::from);
        let near = near.iter().map(|file| file.to_path_buf());
        let of_user = home.map(|home| home.join(".povray/3.7/povray.ini"));
        let mut candidates = named.clone().into_iter().chain(near).chain(of_user);
        Environment {
            system_ini: system_ini(Path::new("/etc/povray")),
            warning: missing
                .map(|file| format!("`POVINI` names `{}`, which is not there", file.display())),
            is_terminal: io::stderr().is_terminal(),
            is_povray: false,
            user_ini: candidates.find(|file| file.is_file()),
            conf: Conf::of_this_process(),
        }
    }

    /// The folders of the system's ini file, which are searched last for includes and ini files.
    pub(crate) fn standard_folders(&self) -> Result<Vec<PathBuf>, CliError> {
        self.system_args().map(|system| system.library_paths)
    }

    /// The folders of POV-Ray 3.8 where its ini file is installed beside that of 3.7: searched before the standard ones
    /// for scenes of version 3.8.
    fn standard_folders_of_3_8(&self) -> Result<Vec<PathBuf>, CliError> {
        let folder = self.system_ini.as_deref().and_then(Path::parent);
        let of_3_8 = folder
            .and_then(Path::parent)
            .map(|all| all.join("3.8/povray.ini"));
        let mut raw_args = RawArgs::default();
        if let Some(file) = of_3_8.filter(|file| file.is_file()) {
            Reader::new(&mut raw_args, &[]).read_file(&file, None)?;
        }
        Ok(raw_args.library_paths)
    }

    /// The options of the system's ini file.
    pub(crate) fn system_args(&self) -> Result<RawArgs, CliError> {
        let mut system = RawArgs::default();
        if let Some(file) = &self.system_ini {
            Reader::new(&mut system, &[]).read_file(file, None)?;
        }
        Ok(system)
    }

    /// The default format of messages: source lines for people, POV-Ray's one line for programs.
    pub(crate) fn message_format(&self) -> MessageFormat {
        if self.is_terminal && !self.is_povray {
            MessageFormat::Human
        } else {
            MessageFormat::Povray
        }
    }

    /// The options before the first argument is read: those of the user's ini file.
    pub(crate) fn raw_args(&self, standard_folders: &[PathBuf]) -> Result<RawArgs, CliError> {
        let mut raw_args = RawArgs {
            is_povray: self.is_povray,
            standard_folders_of_3_8: self.standard_folders_of_3_8()?,
            ..RawArgs::default()
        };
        raw_args.doubts.extend(self.warning.clone());
        raw_args.doubts.extend(self.conf.doubts.iter().cloned());
        if let Some(file) = &self.user_ini {
            Reader::new(&mut raw_args, standard_folders).read_file(file, None)?;
        }
        Ok(raw_args)
    }
}

/// The ini file of the first version that is installed.
fn system_ini(folder: &Path) -> Option<PathBuf> {
    let mut files = ["3.7", "3.8"]
        .map(|version| folder.join(version).join("povray.ini"))
        .into_iter();
    files.find(|file| file.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn povray_3_8_alone_gives_its_include_folders() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        assert_eq!(system_ini(folder.path()), None);
        for version in ["3.8", "3.7"] {
            let own = folder.path().join(version);
            fs::create_dir(&own)?;
            fs::write(own.join("povray.ini"), "")?;
            assert_eq!(system_ini(folder.path()), Some(own.join("povray.ini")));
        }
        Ok(())
    }
}
