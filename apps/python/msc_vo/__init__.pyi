# Types for editors and type checkers; the docstrings are those of the module. Read-only attributes
# are Final, or properties in classes whose methods change them.
from os import PathLike
from typing import (Any, Callable, ClassVar, Dict, Final, Iterable, Iterator, List, Literal,
                    Mapping, Optional, Tuple, TypeVar, Union)
from typing import Sequence as _Sequence

import numpy as np
import numpy.typing as npt

__version__: str

_T = TypeVar("_T")
_Path = Union[str, "PathLike[str]"]
_OptionValue = Union[bool, int, float, str, None]
_Numbers = npt.ArrayLike
_Floats = npt.NDArray[np.float64]
_Ids = npt.NDArray[np.int64]
_Flags = npt.NDArray[np.bool_]
_Status = Literal["tracked", "weak", "predicted", "lost", "dropped", "unreadable"]
_Cause = Literal["uniform_image", "few_features", "no_depth", "depth_out_of_range", "no_match",
                 "implausible"]
_LogLevel = Literal["debug", "info", "warning", "error", "off"]
_LensModel = Literal["radial-tangential", "rational", "fisheye"]
_Trajectory = Union[_Path, npt.NDArray[Any], "Result"]

def set_log_level(level: _LogLevel) -> None: ...

class UnreadableImage(RuntimeError): ...

class _Value:
    def __copy__(self: _T) -> _T: ...
    def __deepcopy__(self: _T, memo: Dict[int, Any]) -> _T: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Camera(_Value):
    def __init__(self, fx: float, fy: float, cx: float, cy: float, width: int,
                 height: int) -> None: ...
    fx: Final[float]
    fy: Final[float]
    cx: Final[float]
    cy: Final[float]
    width: Final[int]
    height: Final[int]
    matrix: Final[_Floats]

class Lens(_Value):
    def __init__(self, model: _LensModel, coefficients: _Numbers) -> None: ...
    model: Final[_LensModel]
    coefficients: Final[List[float]]
    recorded: Final[Optional[Camera]]

def undistorted_camera(camera: Camera, lens: Lens,
                       field_of_view: Optional[float] = None) -> Tuple[Camera, Lens]: ...

class DepthCamera(_Value):
    def __init__(self, camera: Camera, depth_from_color: _Numbers,
                 distortion: Optional[Union[_Numbers, Lens]] = None,
                 inverse_depth_offset: float = 0.0) -> None: ...
    camera: Final[Camera]
    depth_from_color: Final[_Floats]
    distortion: Final[Lens]
    inverse_depth_offset: Final[float]

class DepthRegistration:
    def __init__(self, depth_camera: DepthCamera, camera: Camera,
                 distortion: Optional[Union[_Numbers, Lens]] = None) -> None: ...
    def register(self, depth: npt.NDArray[Any], *,
                 depth_scale: Optional[float] = None) -> npt.NDArray[np.float32]: ...

class _OptionTable:
    def __init__(self, **options: _OptionValue) -> None: ...
    def __getitem__(self, name: str) -> _OptionValue: ...
    def __setitem__(self, name: str, value: _OptionValue) -> None: ...
    def __contains__(self, name: str) -> bool: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[str]: ...
    def keys(self) -> List[str]: ...
    def __copy__(self: _T) -> _T: ...
    def __deepcopy__(self: _T, memo: Dict[int, Any]) -> _T: ...
    def __eq__(self, other: object) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

class Options(_OptionTable):
    @staticmethod
    def read(path: _Path) -> Options: ...

class WindowOptions(_OptionTable): ...

class RgbdImage(_Value):
    id: Final[int]
    timestamp: Final[float]
    depth_delay: Final[float]
    gray: Final[npt.NDArray[np.uint8]]
    depth: Final[npt.NDArray[np.float32]]
    mask: Final[Optional[npt.NDArray[np.uint8]]]

class Sequence:
    def __init__(self, directory: _Path, format: str = "auto", camera: str = "",
                 config: Optional[_Path] = None, mask: Optional[_Path] = None,
                 mask_zero: bool = False) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int) -> RgbdImage: ...
    def __iter__(self) -> Iterator[RgbdImage]: ...
    camera: Final[Camera]
    depth_camera: Final[Optional[DepthCamera]]
    distortion: Final[List[float]]
    lens: Final[Lens]
    depth_scale: Final[float]
    depth_sensor: Final[str]
    readout_time: Final[Optional[float]]
    timestamps: Final[_Floats]
    groundtruth: Final[_Floats]
    directory: Final[str]
    format: Final[str]
    warnings: Final[List[str]]

class FrameResult(_Value):
    id: Final[int]
    timestamp: Final[float]
    status: Final[_Status]
    is_estimated: Final[bool]
    segment: Final[int]
    world: Final[int]
    world_changed: Final[Optional[Tuple[int, Optional[_Floats]]]]
    by_pose_factors: Final[bool]
    is_keyframe: Final[bool]
    cam_from_world: Final[_Floats]
    world_from_cam: Final[_Floats]
    cam_from_odometry: Final[_Floats]
    world_from_odometry: Final[_Floats]
    covariance: Final[Optional[_Floats]]
    world_covariance: Final[Optional[_Floats]]
    odometry_covariance: Final[Optional[_Floats]]
    cause: Final[Optional[_Cause]]
    num_points: Final[int]
    num_lines: Final[int]
    num_with_depth: Final[int]
    num_inlier_points: Final[int]
    num_inlier_lines: Final[int]
    num_dynamic: Final[int]
    times: Final[Dict[str, float]]

class CalibrationEstimate(_Value):
    is_corrected: Final[Dict[str, bool]]
    log_odds: Final[Dict[str, float]]
    correction: Final[Dict[str, float]]
    sigma: Final[Dict[str, float]]

class Result(_Value):
    trajectory: Final[_Floats]
    covariances: Final[_Floats]
    world_covariances: Final[_Floats]
    odometry_covariances: Final[_Floats]
    status: Final[npt.NDArray[np.str_]]
    segment: Final[npt.NDArray[np.int32]]
    segments: Final[List[Dict[str, int]]]
    loops: Final[List[Dict[str, float]]]
    first_localized_frame: Final[Optional[int]]
    estimated: Final[_Flags]
    keyframes: Final[_Floats]
    frames: Final[List[FrameResult]]
    points: Final[_Floats]
    point_observations: Final[npt.NDArray[np.int32]]
    lines: Final[_Floats]
    line_observations: Final[npt.NDArray[np.int32]]
    line_axes: Final[npt.NDArray[np.int32]]
    planes: Final[_Floats]
    plane_extents: Final[List[_Floats]]
    plane_observations: Final[npt.NDArray[np.int32]]
    plane_axes: Final[npt.NDArray[np.int32]]
    axes_state: Final[Literal["none", "coarse", "refined"]]
    world_from_axes: Final[Optional[_Floats]]
    axes_sigma: Final[float]
    calibration: Final[CalibrationEstimate]
    camera: Final[Camera]
    lens: Final[Lens]
    depth_camera: Final[DepthCamera]
    readout_time: Final[float]
    readout_time_sigma: Final[float]
    noise_scale: Final[Dict[str, float]]
    depth_sensor: Final[str]
    earlier_sessions: Final[List[Dict[str, Any]]]
    map_world: Final[int]
    last_window: Final[WindowSummary]
    num_late_maps: Final[int]
    extra_blocks: Final[Dict[int, _Floats]]
    def write_trajectory(self, path: _Path) -> None: ...

class CostFunction:
    def __init__(self, callable: Callable[..., Any], num_residuals: int,
                 block_sizes: _Sequence[int], numeric: bool = False) -> None: ...
    num_residuals: Final[int]
    block_sizes: Final[List[int]]
    def evaluate(self, *blocks: _Numbers) -> Optional[Tuple[_Floats, List[_Floats]]]: ...

def pose_prior(cam_from_world: _Numbers, covariance: _Numbers) -> CostFunction: ...
def relative_pose(b_from_a: _Numbers, covariance: _Numbers) -> CostFunction: ...
def scaled_relative_pose(b_from_a: _Numbers, covariance: _Numbers) -> CostFunction: ...
def gravity_direction(direction: _Numbers, sigma: float) -> CostFunction: ...
def direction_prior(direction: _Numbers, sigma: float) -> CostFunction: ...

class BlockId(_Value):
    @staticmethod
    def pose(keyframe: int) -> BlockId: ...
    @staticmethod
    def point(point: int) -> BlockId: ...
    @staticmethod
    def line(line: int) -> BlockId: ...
    @staticmethod
    def axes() -> BlockId: ...
    @staticmethod
    def extra(id: int) -> BlockId: ...

class ExtraBlock(_Value):
    def __init__(self, id: int, value: _Numbers,
                 manifold: Literal["euclidean", "sphere"] = "euclidean",
                 fixed: bool = False) -> None: ...
    id: Final[int]
    value: Final[_Floats]
    manifold: Final[Literal["euclidean", "sphere"]]
    fixed: Final[bool]

class CustomFactor:
    def __init__(self, cost: CostFunction, blocks: _Sequence[BlockId],
                 huber: Optional[float] = None, name: str = "factor") -> None: ...
    name: Final[str]
    blocks: Final[List[BlockId]]

class PoseFactor:
    def __init__(self, cost: CostFunction, huber: Optional[float] = None,
                 name: str = "factor") -> None: ...
    name: Final[str]

class WindowKeyframe(_Value):
    id: Final[int]
    timestamp: Final[float]
    fixed: Final[bool]
    cam_from_world: Final[_Floats]

class WindowContext:
    keyframes: Final[List[WindowKeyframe]]
    world_from_axes: Final[Optional[_Floats]]
    extra_blocks: Final[Dict[int, _Floats]]
    world: Final[int]
    data: Final[WindowData]

class FrameContext(_Value):
    timestamp: Final[float]
    last_timestamp: Final[float]
    last_cam_from_world: Final[_Floats]
    predicted_cam_from_world: Final[_Floats]
    world: Final[int]
    extra_blocks: Final[Dict[int, _Floats]]

class Map:
    window: Final[WindowData]
    timestamps: Final[_Floats]
    world_from_axes: Final[Optional[_Floats]]

def map_images(file: _Path) -> Dict[int, bytes]: ...

class TrackedImage:
    frame: Final[FrameResult]
    gray: Final[npt.NDArray[np.uint8]]
    depth: Final[npt.NDArray[np.float32]]
    points: Final[_Floats]
    point_depths: Final[_Floats]
    point_landmarks: Final[_Ids]
    lines: Final[_Floats]
    line_depths: Final[_Floats]
    line_landmarks: Final[_Ids]
    map: Final[Map]

class Odometry:
    def __init__(self, options: Optional[Options], camera: Camera,
                 distortion: Optional[Union[_Numbers, Lens]] = None) -> None: ...
    def process(self, timestamp: float, gray: npt.NDArray[np.uint8], depth: npt.NDArray[Any], *,
                depth_scale: Optional[float] = None, depth_delay: float = 0.0,
                mask: Optional[npt.NDArray[np.uint8]] = None) -> FrameResult: ...
    def drop(self, timestamp: float,
             status: Literal["dropped", "unreadable"] = "dropped") -> FrameResult: ...
    @property
    def mapping_pending(self) -> bool: ...
    def run_mapping(self, budget: float) -> bool: ...
    def finish(self) -> Result: ...
    @property
    def frames(self) -> List[FrameResult]: ...
    def set_window_factors(
        self, callback: Optional[Callable[[WindowContext],
                                          Optional[Iterable[Union[CustomFactor, ExtraBlock]]]]]
    ) -> None: ...
    def set_pose_factors(
        self, callback: Optional[Callable[[FrameContext], Optional[Iterable[PoseFactor]]]]
    ) -> None: ...
    def set_window_observer(
        self, callback: Optional[Callable[[int, WindowData, WindowOptions], Any]]) -> None: ...
    def set_tracking_observer(
        self, callback: Optional[Callable[[TrackedImage], Any]]) -> None: ...
    def skip_clipped_depth_search(self) -> None: ...
    def map(self) -> Map: ...
    def load_map(self, file: _Path, *, only_localize: bool = ...) -> None: ...
    def save_map(self, file: _Path, session: str = ..., *,
                 images: Mapping[int, bytes] = ...) -> None: ...
    def save(self, folder: _Path) -> None: ...
    def restore(self, folder: _Path) -> None: ...

class Localizer(Odometry):
    def __init__(self, options: Optional[Options], camera: Camera, map: _Path,
                 distortion: Optional[Union[Lens, _Numbers]] = ...) -> None: ...

class ErrorStatistics(_Value):
    count: Final[int]
    rmse: Final[float]
    mean: Final[float]
    median: Final[float]
    p95: Final[float]
    min: Final[float]
    std: Final[float]
    sse: Final[float]
    max: Final[float]

class RelativeError(_Value):
    translation: Final[ErrorStatistics]
    rotation: Final[ErrorStatistics]

class TrajectoryError(_Value):
    ape: Final[ErrorStatistics]
    rotation: Final[ErrorStatistics]
    ape_rotation: Final[ErrorStatistics]
    rpe: Final[RelativeError]
    rpe_per_second: Final[RelativeError]
    rpe_per_metre: Final[RelativeError]
    num_reference: Final[int]
    num_estimate: Final[int]
    num_not_estimated: Final[int]
    num_matched: Final[int]
    coverage: Final[float]
    coverage_in_range: Final[float]
    scale: Final[float]
    matched_reference: Final[_Floats]
    matched_estimate: Final[_Floats]
    path_length: Final[float]
    warnings: Final[List[str]]
    reference_from_estimate: Final[_Floats]
    per_pose: Final[_Floats]

def evaluate(gt: _Trajectory, est: _Trajectory, *,
             align: Literal["se3", "sim3", "origin", "none"] = "se3",
             max_dt: float = 0.02, all_poses: bool = False, rpe_delta: float = 1.0,
             rpe_unit: Literal["frames", "metres", "seconds"] = "frames",
             rpe_all_pairs: bool = False) -> TrajectoryError: ...

class WindowData:
    def __init__(self, camera: Camera) -> None: ...
    def add_keyframes(self, ids: _Numbers, cam_from_world: _Numbers,
                      fixed: Optional[_Numbers] = None) -> None: ...
    def add_points(self, ids: _Numbers, positions: _Numbers, fixed: Optional[_Numbers] = None,
                   noise: _Numbers = 1.0) -> None: ...
    def add_lines(self, ids: _Numbers, segments: _Numbers, fixed: Optional[_Numbers] = None,
                  noise: _Numbers = 1.0, depth_offsets: _Numbers = 0.0) -> None: ...
    def add_point_observations(self, keyframes: _Numbers, points: _Numbers, pixels: _Numbers,
                               sigmas: _Numbers = 1.0, inverse_depths: _Numbers = 0.0,
                               inverse_depth_sigmas: _Numbers = 0.0) -> None: ...
    def add_line_observations(self, keyframes: _Numbers, lines: _Numbers, segments: _Numbers,
                              sigmas: _Numbers = 1.0, inverse_depths: Optional[_Numbers] = None,
                              depth_covariances: Optional[_Numbers] = None) -> None: ...
    def add_parallel_pairs(self, a: _Numbers, b: _Numbers, sigmas: _Numbers = 0.03,
                           counts: Optional[_Numbers] = None) -> None: ...
    def add_perpendicular_pairs(self, a: _Numbers, b: _Numbers, sigmas: _Numbers = 0.03,
                                counts: Optional[_Numbers] = None) -> None: ...
    def add_axis_alignments(self, lines: _Numbers, axes: _Numbers,
                            sigmas: _Numbers = 0.03) -> None: ...
    def add_pose_prior(self, keyframe: int, cam_from_world: _Numbers,
                       covariance: _Numbers) -> None: ...
    def set_axes(self, world_from_axes: _Numbers, fixed: bool = True) -> None: ...
    def add(self, items: Iterable[Union[CustomFactor, ExtraBlock]]) -> None: ...
    def set_keyframe_fixed(self, keyframe: int, fixed: bool = True) -> None: ...
    def __copy__(self) -> WindowData: ...
    def __deepcopy__(self, memo: Dict[int, Any]) -> WindowData: ...
    def __eq__(self, other: object) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]
    @property
    def camera(self) -> Camera: ...
    @property
    def keyframe_ids(self) -> _Ids: ...
    @property
    def cam_from_world(self) -> _Floats: ...
    @property
    def keyframe_fixed(self) -> _Flags: ...
    @property
    def point_ids(self) -> _Ids: ...
    @property
    def points(self) -> _Floats: ...
    @property
    def point_fixed(self) -> _Flags: ...
    @property
    def point_noise(self) -> _Floats: ...
    @property
    def line_ids(self) -> _Ids: ...
    @property
    def lines(self) -> _Floats: ...
    @property
    def line_fixed(self) -> _Flags: ...
    @property
    def line_noise(self) -> _Floats: ...
    @property
    def line_depth_offsets(self) -> _Floats: ...
    @property
    def world_from_axes(self) -> Optional[_Floats]: ...
    @property
    def point_observations(self) -> Dict[str, npt.NDArray[Any]]: ...
    @property
    def line_observations(self) -> Dict[str, npt.NDArray[Any]]: ...
    @property
    def parallel_pairs(self) -> Dict[str, npt.NDArray[Any]]: ...
    @property
    def perpendicular_pairs(self) -> Dict[str, npt.NDArray[Any]]: ...
    @property
    def axis_alignments(self) -> Dict[str, npt.NDArray[Any]]: ...
    @property
    def pose_priors(self) -> List[Dict[str, Any]]: ...
    @property
    def point_observation_rejected(self) -> _Flags: ...
    @property
    def point_depth_rejected(self) -> _Flags: ...
    @property
    def line_observation_rejected(self) -> _Flags: ...
    @property
    def line_depth_rejected(self) -> _Flags: ...
    @property
    def parallel_rejected(self) -> _Flags: ...
    @property
    def perpendicular_rejected(self) -> _Flags: ...
    @property
    def axis_alignment_rejected(self) -> _Flags: ...
    @property
    def extra_blocks(self) -> Dict[int, _Floats]: ...

class WindowSummary(_Value):
    usable: Final[bool]
    num_iterations: Final[int]
    num_accepted: Final[int]
    initial_cost: Final[float]
    final_cost: Final[float]
    undetermined_keyframes: Final[List[int]]
    undetermined_points: Final[List[int]]
    undetermined_lines: Final[List[int]]
    message: Final[str]
    terms: Final[Dict[str, Dict[str, float]]]
    def report(self) -> str: ...

def read_window(path: _Path) -> Tuple[WindowData, WindowOptions]: ...
def write_window(path: _Path, window: WindowData,
                 options: Optional[WindowOptions] = None) -> None: ...
def solve_window(window: WindowData, options: Optional[WindowOptions] = None) -> WindowSummary: ...
def window_covariance(window: WindowData, options: Optional[WindowOptions] = None, *,
                      keyframes: _Numbers = (), points: _Numbers = (), lines: _Numbers = (),
                      extra_blocks: _Numbers = ()) -> Dict[str, Dict[int, Optional[_Floats]]]: ...
def replay(sequence: Union[Sequence, _Path],
           options: Optional[Union[_OptionTable, Mapping[str, _OptionValue]]] = None,
           on_frame: Optional[Callable[[FrameResult], Any]] = None,
           on_tracked: Optional[Callable[[TrackedImage], Any]] = None) -> Result: ...
