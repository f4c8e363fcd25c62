// Two layers of rock and a natural fracture in the upper one: gmsh -2 rock.geo -o rock.msh
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 0.4, 0.1};      // lower layer
Rectangle(2) = {0, 0.1, 0, 0.4, 0.2};    // upper layer
Point(101) = {0.18, 0.15, 0}; Point(102) = {0.26, 0.21, 0}; Line(101) = {101, 102};
BooleanFragments{ Surface{1, 2}; Delete; }{ Curve{101}; Delete; }
lower() = Surface In BoundingBox {-1, -1, -1, 1, 0.101, 1};
upper() = Surface In BoundingBox {-1, 0.099, -1, 1, 1, 1};
natural() = Curve In BoundingBox {0.17, 0.14, -1, 0.27, 0.22, 1};
Physical Surface("shale") = lower();
Physical Surface("sand") = upper();
Physical Curve("natural") = natural();
Mesh.MeshSizeMin = 0.01; Mesh.MeshSizeMax = 0.01;
