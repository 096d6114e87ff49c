"""The shapes, materials and files of Lucarne's example scenes. Run ../make_scenes.py to write them."""
