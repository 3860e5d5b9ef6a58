#include "SwardGrass.h"

#include "SwardPlace.h"

#include "Components/HierarchicalInstancedStaticMeshComponent.h"

ASwardGrass::ASwardGrass()
{
    RootComponent = CreateDefaultSubobject<USceneComponent>(TEXT("Root"));
}

void ASwardGrass::BeginPlay()
{
    Super::BeginPlay();
    Load();
}

void ASwardGrass::Load()
{
    for (UHierarchicalInstancedStaticMeshComponent* Former : Grown)
        Former->DestroyComponent();
    Grown.Empty();

    sward_field* Opened = nullptr;
    sward_field_info Info = {};
    if (Blades.Num() == 0 || sward_field_open(TCHAR_TO_UTF8(*Field.FilePath), &Opened) != SWARD_OK ||
        sward_field_get_info(Opened, &Info) != SWARD_OK) {
        UE_LOG(LogTemp, Error, TEXT("%s"),
               Blades.Num() == 0 ? TEXT("SwardGrass: Blades is empty") : UTF8_TO_TCHAR(sward_last_error()));
        sward_field_destroy(Opened);
        return;
    }

    TArray<TArray<FTransform>> Transforms;
    Transforms.SetNum(Info.species_count);
    TArray<sward_blade> Rows;
    for (uint64 First = 0; First < Info.blade_count; First += 4096) {
        const uint64 Count = FMath::Min<uint64>(4096, Info.blade_count - First);
        Rows.SetNum(static_cast<int32>(Count));
        if (sward_field_read_blades(Opened, First, Count, Rows.GetData()) != SWARD_OK)
            break;
        for (const sward_blade& Row : Rows) {
            if (Row.ribbon != 0) // a leaf on the stalk before it
                continue;
            const sward_unreal::Place P = sward_unreal::placeOf(Info, Row);
            Transforms[Row.species].Emplace(
                FQuat(P.rotation[0], P.rotation[1], P.rotation[2], P.rotation[3]),
                FVector(P.position[0], P.position[1], P.position[2]), FVector(P.scale[0], P.scale[1], P.scale[2]));
        }
    }
    sward_field_destroy(Opened);

    for (int32 Species = 0; Species < Transforms.Num(); ++Species) {
        auto* Component = NewObject<UHierarchicalInstancedStaticMeshComponent>(this);
        Component->SetStaticMesh(Blades[FMath::Min(Species, Blades.Num() - 1)]);
        Component->SetCastShadow(bCastsShadows);
        Component->SetCollisionEnabled(ECollisionEnabled::NoCollision);
        Component->SetCullDistances(FadeDistance.Min, FadeDistance.Max);
        Component->SetupAttachment(RootComponent);
        Component->RegisterComponent();
        Component->AddInstances(Transforms[Species], false);
        Grown.Add(Component);
    }
}
