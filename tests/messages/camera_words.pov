// mistakes in lines 2, 3: words of other programs in a camera
camera { position <0, 0, -5> }
camera { location <0, 0, -5> fov 45 look_at 0 }
