"""kitti360."""
