"""`earshot.gym.sb3` under its name of before."""

from earshot.gym.sb3 import SearchVecEnv, describe, export_onnx, save

__all__ = ["SearchVecEnv", "describe", "export_onnx", "save"]
