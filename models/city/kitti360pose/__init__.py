"""kitti360pose."""
