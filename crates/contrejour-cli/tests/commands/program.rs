//! Runs of the binary, each in a folder of its own.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

/// What drivers print on standard error by themselves.
const DRIVER_LINES: [&str; 4] = ["error: XDG_RUNTIME_DIR", "MESA", "WARNING: lavapipe", "libEGL"];

const BINARY: &str = env!("CARGO_BIN_EXE_contrejour");

/// A folder in which the binary runs.
pub struct Folder {
    folder: TempDir,
}

/// What a run left.
pub struct Run {
    command: String,
    output: Output,
}

impl Folder {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder can be made") }
    }

    /// A folder with text files in it.
    pub fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self::new();
        for (name, text) in files {
            fs::write(folder.path(name), text).expect("a temporary file can be written");
        }
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Names of all files in it, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("the folder can be read");
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("the folder can be read").file_name();
        let mut names: Vec<_> = entries.map(|entry| name(entry).to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    pub fn read(&self, name: &str) -> Result<String, String> {
        fs::read_to_string(self.path(name)).map_err(|error| format!("{name}: {error}"))
    }

    /// Width and height of a picture, from its header.
    pub fn png_size(&self, name: &str) -> Result<[u32; 2], String> {
        let bytes = fs::read(self.path(name)).map_err(|error| format!("{name}: {error}"))?;
        if bytes.len() < 24 || !bytes.starts_with(b"\x89PNG\r\n\x1a\n") || &bytes[12..16] != b"IHDR" {
            return Err(format!("{name} is no PNG"));
        }
        let number = |at: usize| u32::from_be_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]]);
        Ok([number(16), number(20)])
    }

    /// Checks that arguments are refused in one line that tells all these words, and that no file is left.
    pub fn refuses(&self, arguments: &str, told: &[&str]) -> Result<(), String> {
        let before = self.names();
        let line = self.run(arguments).refusal()?;
        if let Some(word) = told.iter().find(|word| !line.contains(*word)) {
            return Err(format!("{word:?} is not told: {line}"));
        }
        let after = self.names();
        if before == after { Ok(()) } else { Err(format!("files were left: {after:?}")) }
    }

    /// Runs the binary with arguments that spaces separate.
    pub fn run(&self, arguments: &str) -> Run {
        self.run_by(&mut Command::new(BINARY), arguments)
    }

    /// Runs a line of a shell whose arguments, from the first on, are the binary and its own.
    #[cfg(unix)]
    pub fn run_in_shell(&self, line: &str, arguments: &str) -> Run {
        self.run_by(Command::new("sh").args(["-c", line, "sh", BINARY]), arguments)
    }

    /// Runs a copy of the binary as a user without rights; only the superuser can.
    #[cfg(unix)]
    pub fn run_as_nobody(&self, arguments: &str) -> Result<Run, String> {
        use std::os::unix::fs::PermissionsExt;

        // Somewhere that everybody may look at.
        let text = |error: std::io::Error| error.to_string();
        fs::set_permissions(self.folder.path(), PermissionsExt::from_mode(0o777)).map_err(text)?;
        let copy = self.path("contrejour");
        fs::copy(BINARY, &copy).map_err(text)?;
        let mut command = Command::new("setpriv");
        command.args(["--reuid=65534", "--regid=65534", "--clear-groups"]).arg(copy);
        Ok(self.run_by(&mut command, arguments))
    }

    fn run_by(&self, command: &mut Command, arguments: &str) -> Run {
        let command = command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        Run { command: format!("contrejour {arguments}"), output: command.output().expect("the binary runs") }
    }
}

impl Run {
    /// Standard output of a run that ended well.
    pub fn stdout(&self) -> Result<String, String> {
        self.ends_with(0)?;
        String::from_utf8(self.output.stdout.clone()).map_err(|_| self.wrong("what it prints should be text"))
    }

    /// The same as JSON.
    pub fn json(&self) -> Result<serde_json::Value, String> {
        serde_json::from_str(&self.stdout()?).map_err(|error| self.wrong(&format!("it should print JSON: {error}")))
    }

    /// What it says on standard error.
    pub fn told(&self) -> String {
        String::from_utf8_lossy(&self.output.stderr).into_owned()
    }

    /// Checks the exit status.
    pub fn ends_with(&self, status: i32) -> Result<(), String> {
        match self.output.status.code() == Some(status) {
            true => Ok(()),
            false => Err(self.wrong(&format!("it should end with {status}"))),
        }
    }

    /// The one line on standard error of a run that ended with 2 and printed nothing else.
    pub fn refusal(&self) -> Result<String, String> {
        self.ends_with(2)?;
        if !self.output.stdout.is_empty() {
            return Err(self.wrong("it should print nothing on standard output"));
        }
        let text = String::from_utf8_lossy(&self.output.stderr).into_owned();
        let is_ours = |line: &&str| !DRIVER_LINES.iter().any(|driver| line.starts_with(driver));
        match text.lines().filter(is_ours).collect::<Vec<_>>()[..] {
            [line] if line.starts_with("contrejour: ") => Ok(line.to_owned()),
            _ => Err(self.wrong("it should print one line on standard error")),
        }
    }

    fn wrong(&self, what: &str) -> String {
        let [out, err] = [&self.output.stdout, &self.output.stderr].map(|bytes| String::from_utf8_lossy(bytes));
        format!("{}: {what}; {}\n{out}\n{err}", self.command, self.output.status)
    }
}

/// A file that comes with the project.
pub fn asset(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets").join(path)
}
