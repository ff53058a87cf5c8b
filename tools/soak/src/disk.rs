//! A disk of one megabyte, which the run's trace fills within seconds.

use std::path::PathBuf;
use std::process::Command;

/// A file system in memory; it is gone with this.
pub struct Disk(PathBuf);

/// `None` where we may not mount one.
pub fn small() -> Option<Disk> {
    let folder = std::env::temp_dir().join(format!("kinetwin-soak-{}", std::process::id()));
    std::fs::create_dir_all(&folder).ok()?;
    let mounted = Command::new("mount").args(["-t", "tmpfs", "-o", "size=1m", "tmpfs"]).arg(&folder).status();
    if mounted.is_ok_and(|status| status.success()) {
        return Some(Disk(folder));
    }
    let _ = std::fs::remove_dir(&folder);
    None
}

impl Disk {
    pub fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
        let _ = std::fs::remove_dir(&self.0);
    }
}
