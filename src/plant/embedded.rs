//! The catalogue and the plants that the program carries with it, so that it runs without a folder of models.

use crate::prototype::source::{Source, SourceError};

/// The files below `models/` as they were when the program was built, under their paths: `models/rig/plant.xml`.
#[derive(Clone, Copy, Debug, Default)]
pub struct Embedded;

macro_rules! embedded {
    ($($path:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../../", $path)))),*]
    };
}

/// Every XML file and every script below `models/`; a test sees to it that none is forgotten.
static FILES: &[(&str, &str)] = embedded![
    "models/catalogue/BoxSensor/avatar.xml",
    "models/catalogue/BoxSensor/prototype.xml",
    "models/catalogue/CartesianRobot/avatar.xml",
    "models/catalogue/CartesianRobot/prototype.xml",
    "models/catalogue/ConveyorCurve/avatar.xml",
    "models/catalogue/ConveyorCurve/prototype.xml",
    "models/catalogue/Dispenser/avatar.xml",
    "models/catalogue/Dispenser/prototype.xml",
    "models/catalogue/EncoderMotor/avatar.xml",
    "models/catalogue/EncoderMotor/prototype.xml",
    "models/catalogue/InverterConveyor/avatar.xml",
    "models/catalogue/InverterConveyor/prototype.xml",
    "models/catalogue/LoadingBay/avatar.xml",
    "models/catalogue/LoadingBay/prototype.xml",
    "models/catalogue/ProximitySensor/avatar.xml",
    "models/catalogue/ProximitySensor/prototype.xml",
    "models/catalogue/Pusher/avatar.xml",
    "models/catalogue/Pusher/prototype.xml",
    "models/catalogue/ServoAxis/avatar.xml",
    "models/catalogue/ServoAxis/prototype.xml",
    "models/catalogue/SixAxisRobot/avatar.xml",
    "models/catalogue/SixAxisRobot/prototype.xml",
    "models/catalogue/StraightConveyor/avatar.xml",
    "models/catalogue/StraightConveyor/prototype.xml",
    "models/catalogue/SuctionCapGripper/avatar.xml",
    "models/catalogue/SuctionCapGripper/prototype.xml",
    "models/catalogue/UnloadingBay/avatar.xml",
    "models/catalogue/UnloadingBay/prototype.xml",
    "models/catalogue/VisionSensor/avatar.xml",
    "models/catalogue/VisionSensor/prototype.xml",
    "models/curve/plant.xml",
    "models/depalletizer/plant.xml",
    "models/packaging/plant.xml",
    "models/packaging/prototypes/CollaborativeRobot/avatar.xml",
    "models/packaging/prototypes/CollaborativeRobot/prototype.xml",
    "models/packaging/prototypes/Conveyor/avatar.xml",
    "models/packaging/prototypes/Conveyor/builder.js",
    "models/packaging/prototypes/Conveyor/prototype.xml",
    "models/packaging/prototypes/Denester/avatar.xml",
    "models/packaging/prototypes/Denester/builder.js",
    "models/packaging/prototypes/Denester/prototype.xml",
    "models/packaging/prototypes/Exit/avatar.xml",
    "models/packaging/prototypes/Exit/builder.js",
    "models/packaging/prototypes/Exit/prototype.xml",
    "models/packaging/prototypes/Sealer/avatar.xml",
    "models/packaging/prototypes/Sealer/builder.js",
    "models/packaging/prototypes/Sealer/prototype.xml",
    "models/r001/plant.xml",
    "models/r001/prototypes/Block/avatar.xml",
    "models/r001/prototypes/Block/prototype.xml",
    "models/rig-toleranced/plant.xml",
    "models/rig/plant.xml",
    "models/servo-arm/plant.xml",
    "models/servo-pendulum/kp100.xml",
    "models/servo-pendulum/kp200.xml",
    "models/servo-pendulum/kp400.xml",
    "models/servo-pendulum/kp800.xml",
    "models/servo-pendulum/plant.xml",
];

impl Embedded {
    /// The paths of all files, sorted.
    pub fn paths() -> impl Iterator<Item = &'static str> {
        FILES.iter().map(|(path, _)| *path)
    }
}

impl Source for Embedded {
    fn read(&self, path: &str) -> Result<String, SourceError> {
        let file = FILES.iter().find(|(known, _)| *known == path);
        file.map(|(_, text)| (*text).to_owned()).ok_or_else(|| SourceError::NotFound { path: path.to_owned() })
    }
}
